#include "relief/stroke_fields.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/lists.h"
#include "scan/jumps.h"

namespace relievo {

template <typename Real>
void protect(const CorrectedHeights<Real>& heights, const StrokeMask& mask, double amount) {
  const std::span<Real> z = heights.z;
  const auto correction = [&](Index i) { return static_cast<double>(z[i] - heights.uncorrected[i]); };
  const Vec3 middle = heights.surface.points[mask.points[0]];
  const auto terms_at = [&](Index i) {
    const Vec3 away = heights.surface.points[i] - middle;
    return Vec3(away.x(), away.y(), heights.surface.rho);
  };
  // The small diagonal keeps the matrix regular if the mask has no width.
  Mat3 squares = Mat3::Identity() * 1e-12 * heights.surface.rho * heights.surface.rho;
  Vec3 sums = Vec3::Zero();
  for (std::size_t k = 0; k < mask.points.size(); ++k) {
    const Vec3 terms = terms_at(mask.points[k]);
    const auto weight = static_cast<double>(mask.weights[k]);
    squares += weight * terms * terms.transpose();
    sums += weight * correction(mask.points[k]) * terms;
  }
  const Vec3 plane = squares.ldlt().solve(sums);
  std::vector<double> wanted;
  for (const Index i : mask.points)
    wanted.push_back(static_cast<double>(heights.uncorrected[i]) + plane.dot(terms_at(i)));
  const double excess = std::max(0., std::ranges::max(wanted) - heights.height);
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    Real& height = z[mask.points[k]];
    height += static_cast<Real>(amount * static_cast<double>(mask.weights[k])) *
              (static_cast<Real>(wanted[k] - excess) - height);
  }
}

std::vector<Crossing> crossings_of(const Surface& surface, const StrokeMask& mask) {
  const std::vector<Index> number = places_in(mask.points, surface.points.size());
  std::vector<Crossing> crossings;
  each_side_inside(surface, [&](Index front, Index behind) {
    if (surface.points[front].z() < surface.points[behind].z()) std::swap(front, behind);
    const Index k = number[front];
    if (k == no_index || number[behind] != no_index || mask.weights[k] < .5F) return;
    if (is_jump(surface, front, behind)) crossings.push_back({k, behind});
  });
  return crossings;
}

template <typename Real>
void bring_forward(const InFront<Real>& wanted, const StrokeMask& mask, std::span<Real> z) {
  const Real height = wanted.height;
  if (!(height > 0)) return;
  const auto room = [&](Index i) { return std::max(1 - z[i] / height, Real(0)); };
  Real rise = 0;
  for (const auto& [k, behind] : wanted.crossings) {
    const Index from = mask.points[k];
    const Real lacking = z[behind] + wanted.step - z[from],
               share = static_cast<Real>(mask.weights[k]) * room(from);
    if (lacking > 0) rise = std::max(rise, lacking >= share * height ? height : lacking / share);
  }
  for (std::size_t k = 0; k < mask.points.size(); ++k) {
    const Index i = mask.points[k];
    z[i] += rise * static_cast<Real>(mask.weights[k]) * room(i);
  }
}

template void protect(const CorrectedHeights<float>&, const StrokeMask&, double);
template void protect(const CorrectedHeights<double>&, const StrokeMask&, double);
template void bring_forward(const InFront<float>&, const StrokeMask&, std::span<float>);
template void bring_forward(const InFront<double>&, const StrokeMask&, std::span<double>);

}  // namespace relievo
