#include "membrane.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "extent.h"
#include "height_tails.h"
#include "memory.h"
#include "relievo/parallel.h"

namespace relievo {
namespace {

// Cells are as wide as that, of the longer side; in rho, where points are too few for it.
constexpr double cell_size = .01, least_cell_size = 2;
constexpr int sweeps = 30, smoothings = 4;
constexpr float over_relaxation = 1.8F;
constexpr double least_share = .66, share_growth = .2;
constexpr float infinity = std::numeric_limits<float>::infinity();

std::vector<Index> free_points(const Boundary& boundary) {
  std::vector<Index> found;
  for (Index i = 0; i < boundary.is_boundary.size(); ++i)
    if (!boundary.is_boundary[i]) found.push_back(i);
  return found;
}

double cell_width(const Surface& surface) {
  const double side = longer_side_of(surface.points);
  return side > 0 ? std::max(cell_size * side, least_cell_size * surface.rho) : 1;
}

// Per node: near a point, or in a gap between points.
std::vector<std::uint8_t> is_inside(const Surface& surface, const Lattice& lattice) {
  std::vector<std::uint8_t> inside(lattice.nodes());
  for (std::size_t n = 0; n < inside.size(); ++n) inside[n] = lattice.is_reached(n);
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t)
    if (surface.boundary.is_inside[t]) lattice.mark_nodes_in(surface.triangulation.triangles[t], inside);
  return inside;
}

}  // namespace

std::size_t Membrane::Workspace::memory() const {
  return bytes(sums) + bytes(rests) + bytes(heights) + bytes(lowest) + bytes(highest) + bytes(wanted) +
         bytes(membrane) + bytes(smoothed);
}

Membrane::Membrane(const Surface& surface)
    : lattice_(surface.points, free_points(surface.boundary), cell_width(surface)), ranks_(lattice_.nodes()) {
  const double side = longer_side_of(surface.points);
  if (side > 0) pull_ = static_cast<float>(std::pow(cell_width(surface) / (reach * side), 2));
  std::vector<Lattice::Corners> sums(lattice_.nodes());
  const std::vector<double> ranks = depth_ranks(surface.points);
  lattice_.gather(std::span<const double>(ranks), sums, ranks_);
  const std::vector<std::uint8_t> is_active = is_inside(surface, lattice_);
  for (Index n = 0; n < is_active.size(); ++n)
    if (is_active[n]) active_[(n % lattice_.width() + n / lattice_.width()) % 2].push_back(n);
}

Membrane::Workspace Membrane::make_workspace() const {
  Workspace w;
  const std::size_t n = lattice_.nodes();
  w.sums.resize(n), w.rests.resize(n);
  for (std::vector<float>* values : {&w.heights, &w.lowest, &w.highest, &w.wanted, &w.membrane, &w.smoothed})
    values->resize(n);
  return w;
}

std::size_t Membrane::memory() const {
  return lattice_.memory() + bytes(ranks_) + bytes(active_[0]) + bytes(active_[1]);
}

// What heights do between nodes in the cells around one.
Lattice::Extent Membrane::rest_around(std::size_t node, const Workspace& w) const {
  Lattice::Extent rest{infinity, -infinity};
  lattice_.each_cell(node, [&](std::size_t cell, std::size_t) {
    rest.lowest = std::min(rest.lowest, w.rests[cell].lowest);
    rest.highest = std::max(rest.highest, w.rests[cell].highest);
  });
  return rest;
}

void Membrane::set_limits(float height, Workspace& w) const {
  for (const std::vector<Index>& colour : active_)
    for (const Index n : colour) {
      w.lowest[n] = -infinity, w.highest[n] = infinity, w.wanted[n] = 0;
      if (!lattice_.is_reached(n)) continue;  // in a gap: its neighbours bridge it
      const Lattice::Extent rest = rest_around(n, w);
      w.lowest[n] = -w.heights[n] - rest.lowest;
      w.highest[n] = height - w.heights[n] - rest.highest;
      if (w.lowest[n] > w.highest[n]) w.lowest[n] = w.highest[n] = (w.lowest[n] + w.highest[n]) / 2;
      w.wanted[n] = pull_ * (height * ranks_[n] - w.heights[n]);
    }
}

// Successive over-relaxation in red and black, each node held within its limits; other nodes are 0.
void Membrane::relax(Workspace& w) const {
  const std::size_t row = lattice_.width();
  std::vector<float>& b = w.membrane;
  for (const std::vector<Index>& colour : active_)
    for (const Index n : colour) b[n] = std::clamp(0.F, w.lowest[n], w.highest[n]);
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (const std::vector<Index>& colour : active_)
      for (const Index n : colour) {
        const float best = (b[n - 1] + b[n + 1] + b[n - row] + b[n + row] + w.wanted[n]) / (4 + pull_);
        b[n] = std::clamp(b[n] + over_relaxation * (best - b[n]), w.lowest[n], w.highest[n]);
      }
}

// Takes the creases off where it touches its limits.
void Membrane::smooth(Workspace& w) const {
  const std::size_t row = lattice_.width();
  for (int pass = 0; pass < smoothings; ++pass) {
    const std::vector<float>& b = w.membrane;
    for (const std::vector<Index>& colour : active_)
      for (const Index n : colour)
        w.smoothed[n] = (2 * b[n] + b[n - 1] + b[n + 1] + b[n - row] + b[n + row]) / 6;
    w.membrane.swap(w.smoothed);
  }
}

template <typename Real>
void Membrane::spread(std::span<const Real> heights, double height, Workspace& w) const {
  lattice_.gather(heights, w.sums, w.heights);
  lattice_.compare(heights, w.heights, w.rests);
  set_limits(static_cast<float>(height), w);
  relax(w);
  smooth(w);
}

template void Membrane::spread(std::span<const float>, double, Workspace&) const;
template void Membrane::spread(std::span<const double>, double, Workspace&) const;

template <typename Real>
void Membrane::hold(const Heights<Real>& heights, Workspace& workspace) const {
  const std::span<Real> z = heights.values;
  if (!(heights.height > 0)) return;
  spread<Real>(z, heights.height, workspace);
  // The membrane need not be 0 at the silhouette.
  parallel_for(z.size(), [&](std::size_t i) {
    z[i] = static_cast<Real>(heights.boundary_weight[i]) * (z[i] + static_cast<Real>(at(i, workspace)));
  });
  const HeightTails<Real> tails(z);
  if (!(tails.span() > 0)) return;
  const Real scale = static_cast<Real>(heights.height) / tails.span();
  parallel_for(z.size(), [&](std::size_t i) { z[i] = scale * tails(z[i]); });
}

template void Membrane::hold(const Heights<float>&, Workspace&) const;
template void Membrane::hold(const Heights<double>&, Workspace&) const;

double held_share(double u) {
  return 1 - (1 - least_share) * std::exp(-share_growth * u);
}

}  // namespace relievo
