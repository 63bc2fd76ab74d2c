#include "scan/outlines/side_interpolation.h"

#include <algorithm>
#include <cmath>

#include "scan/jumps.h"
#include "scan/linear_field.h"

namespace relievo {
namespace {

constexpr double fit_radius = 2.5;     // in rho; up to 2.56 times as far where points are few
constexpr float least_likeness = .8F;  // cosine of 37 degrees, between normals of one face
constexpr int least_face_points = 5;
constexpr double least_nz = .02;  // normals of the result lean at most 88.9 degrees

}  // namespace

SideInterpolation::SideInterpolation(const Input& input)
    : surface_(input.surface),
      measures_(input.measures),
      grid_(input.grid),
      outline_distance_(input.outline_distance),
      on_outline_(static_cast<float>(half_wall * input.surface.rho)),
      plane_(input.plane.places),
      tree_(input.plane.tree) {}

SideInterpolation::Value SideInterpolation::at(const RowPoint& p) const {
  double radius = fit_radius * surface_.rho;
  std::vector<Match> matches;
  for (int attempt = 0; attempt < 3; ++attempt, radius *= 1.6) {
    tree_.within(p.at, radius, matches);
    leave_same_side(p, matches);
    if (matches.size() >= 6) break;
  }
  // In a sliver between two outlines all points may lie on these. Its silhouette then uses them: without the
  // silhouette, long triangles would span the sliver.
  if (matches.empty() && p.place == Place::silhouette) tree_.within(p.at, fit_radius * surface_.rho, matches);
  if (matches.empty()) return {};
  std::ranges::sort(matches, [](const auto& a, const auto& b) {
    return std::pair(a.second, a.first) < std::pair(b.second, b.first);
  });
  return interpolated(p, radius, matches);
}

// Keeps only the points on the same side as p. Points on an outline may belong to either side, and noise
// moves some points across it. So only points count that lie on one surface with the point farthest from all
// outlines.
void SideInterpolation::leave_same_side(const RowPoint& p, std::vector<Match>& matches) const {
  Index safest = no_index;
  std::erase_if(matches, [&](const auto& m) {
    const float distance = outline_distance_[m.first];
    if (distance < on_outline_) return true;
    const Vec2& place = plane_[m.first];
    constexpr double rounding = 1e-6;
    const bool is_clear = std::isfinite(distance) &&  // infinity far from outlines and outside
                          (place - p.seen_from).norm() < (1 - rounding) * static_cast<double>(distance);
    if (!is_clear && grid_.is_crossed(p.seen_from, place)) return true;
    if (safest == no_index || distance > outline_distance_[safest]) safest = m.first;
    return false;
  });
  std::erase_if(matches,
                [&](const auto& m) { return m.first != safest && is_jump(surface_, safest, m.first); });
  leave_same_face(matches);
}

// Across a crease only the face of the nearest point counts.
void SideInterpolation::leave_same_face(std::vector<Match>& matches) const {
  if (matches.empty()) return;
  const Index nearest = std::ranges::min_element(matches, {}, &Match::second)->first;
  const auto is_other = [&](const auto& m) {
    return surface_.normals[m.first].dot(surface_.normals[nearest]) < least_likeness;
  };
  const std::ptrdiff_t others = std::ranges::count_if(matches, is_other);
  if (static_cast<std::ptrdiff_t>(matches.size()) - others >= least_face_points)
    std::erase_if(matches, is_other);
}

SideInterpolation::Value SideInterpolation::interpolated(const RowPoint& p, double radius,
                                                         std::span<const Match> matches) const {
  LinearField<3> field(p.at, radius);
  for (const auto& [j, distance_sq] : matches) {
    const Vec3f& n = surface_.normals[j];
    field.add(plane_[j], Vec3(static_cast<double>(n.x()), static_cast<double>(n.y()), measures_.k[j]));
  }
  const auto fit = field.fitted();
  Value value;
  value.is_known = true;
  Vec2 lean = fit.value.head<2>();
  const double most = std::sqrt(1 - least_nz * least_nz);
  if (lean.norm() > most) lean *= most / lean.norm();
  const Vec3 normal(lean.x(), lean.y(), std::sqrt(1 - lean.squaredNorm()));
  value.normal = normal.cast<float>();
  value.k = std::clamp(fit.value.z(), -1 / surface_.rho, 1 / surface_.rho);
  value.point << p.at, depth_at(p.at, normal, matches);
  const Index nearest = matches.front().first;
  if (!surface_.colours.empty()) value.colour = surface_.colours[nearest];
  if (!measures_.spacing.empty()) value.spacing = measures_.spacing[nearest];
  return value;
}

// Returns the mean of the depths that the nearest points predict. The chord of a circle is perpendicular to
// the mean of the normals at its ends, which makes this exact where curvature is constant.
double SideInterpolation::depth_at(const Vec2& at, const Vec3& normal, std::span<const Match> matches) const {
  const std::size_t count = std::min<std::size_t>(6, matches.size());
  double depths = 0, weights = 0;
  for (std::size_t m = 0; m < count; ++m) {
    const auto& [j, distance_sq] = matches[m];
    const Vec3 mean = normal + surface_.normals[j].cast<double>();
    const double rise = -mean.head<2>().dot(at - plane_[j]) / std::max(mean.z(), 2 * least_nz);
    const double weight = 1 / (distance_sq + .01 * surface_.rho * surface_.rho);
    depths += weight * (surface_.points[j].z() + rise);
    weights += weight;
  }
  return depths / weights;
}

}  // namespace relievo
