#include "relief/membrane/height_correction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/memory.h"
#include "geometry/extent.h"
#include "relief/membrane/soft_clip.h"
#include "relievo/core/parallel.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

// The width of a cell as a share of the longer side, a quarter of the bending length, which resolves it; and
// the least width in sampling distances, where points are too sparse for that.
constexpr double cell_size = .007, least_cell_size = 2;
// The bending stiffness of a hinge, as a share of that elsewhere: next to none, but the system stays regular.
constexpr float hinge = .001F;
constexpr float infinity = std::numeric_limits<float>::infinity();

std::vector<Index> free_points(const Boundary& boundary) {
  std::vector<Index> found;
  for (Index i = 0; i < boundary.is_boundary.size(); ++i)
    if (!boundary.is_boundary[i]) found.push_back(i);
  return found;
}

struct Scale {
  double side, cell;

  Scale(double longer_side, double rho)
      : side(longer_side), cell(side > 0 ? std::max(cell_size * side, least_cell_size * rho) : 1) {}

  // Returns 0 for a surface without extent.
  float in_cells_squared(double of_side) const {
    return static_cast<float>(std::pow(of_side * side / cell, 2));
  }
};

// Returns, per node, whether it lies near a point or in a gap between points.
std::vector<std::uint8_t> is_inside(const Surface& surface, const Lattice& lattice) {
  std::vector<std::uint8_t> inside(lattice.nodes());
  for (std::size_t n = 0; n < inside.size(); ++n) inside[n] = lattice.is_reached(n);
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t)
    if (surface.boundary.is_inside[t]) lattice.mark_nodes_in(surface.triangulation.triangles[t], inside);
  return inside;
}

// Returns, per node, whether it lies at a depth jump.
std::vector<std::uint8_t> is_at_jump(const Surface& surface, const Lattice& lattice) {
  std::vector<std::uint8_t> marks(lattice.nodes());
  const std::vector<std::uint8_t> jumps = jump_triangles(surface);
  for (std::size_t t = 0; t < jumps.size(); ++t) {
    if (!jumps[t]) continue;
    const Triangle& corners = surface.triangulation.triangles[t];
    lattice.mark_nodes_in(corners, marks);
    for (const Index p : corners) lattice.mark_nodes_around(p, marks);
  }
  return marks;
}

// Returns the tension per node: the harmonic mean of the jump weights used in (9). More tension would smear the
// misfit, which (9) concentrates at depth jumps.
std::vector<float> tension_of(std::span<const float> weights, const Lattice& lattice) {
  std::vector<float> compliance(weights.size()), tension(lattice.nodes());
  for (std::size_t i = 0; i < compliance.size(); ++i) compliance[i] = 1 / weights[i];
  std::vector<Lattice::Corners> sums(lattice.nodes());
  lattice.gather(std::span<const float>(compliance), sums, tension);
  for (std::size_t n = 0; n < tension.size(); ++n) tension[n] = lattice.is_reached(n) ? 1 / tension[n] : 1;
  return tension;
}

std::vector<float> bending_of(const Surface& surface, const Lattice& lattice, const Scale& scale) {
  const std::vector<std::uint8_t> inside = is_inside(surface, lattice), jump = is_at_jump(surface, lattice);
  const std::size_t row = lattice.width();
  const float stiff = scale.in_cells_squared(HeightCorrection::bending_length);
  std::vector<float> bending(lattice.nodes());
  for (std::size_t n = 0; n < bending.size(); ++n) {
    if (!inside[n]) continue;
    const bool is_rim = !(inside[n - 1] && inside[n + 1] && inside[n - row] && inside[n + row]);
    bending[n] = is_rim || jump[n] ? hinge * stiff : stiff;
  }
  return bending;
}

}  // namespace

std::size_t HeightCorrection::Workspace::memory() const {
  std::size_t sum = bytes(sums) + bytes(rests) + bytes(heights) + bytes(tiles);
  for (const solver::ObstacleSolver::Fields& fields : sheet) sum += fields.memory();
  return sum;
}

// Strong compression needs all of the height, so the relief may then stand off the base at the silhouette:
// the stiffness falls from 1 at a share of 1 to 0.1 at 0.775. docs/decisions/height-correction.md has the measurements.
HeightLimits HeightLimits::of(double height, const MembraneParams& params) {
  constexpr double least = .1, fall = 4;
  return {height, params.pull_length, std::max(1 - fall * (1 - params.height_share), least)};
}

HeightCorrection::HeightCorrection(const Surface& surface, std::span<const float> jump_weights)
    : HeightCorrection(surface, jump_weights, longer_side_of(surface.points)) {}

HeightCorrection::HeightCorrection(const Surface& surface, std::span<const float> jump_weights, double side)
    : side_(side),
      cell_(Scale(side, surface.rho).cell),
      lattice_(surface.points, free_points(surface.boundary), cell_),
      sheet_(lattice_.width(),
             {bending_of(surface, lattice_, Scale(side, surface.rho)), tension_of(jump_weights, lattice_)}),
      ranks_(lattice_.nodes()) {
  std::vector<Lattice::Corners> sums(lattice_.nodes());
  const std::vector<double> ranks = depth_ranks(surface.points);
  lattice_.gather(std::span<const double>(ranks), sums, ranks_);
}

HeightCorrection::Workspace HeightCorrection::make_workspace() const {
  Workspace w;
  const std::size_t n = lattice_.nodes();
  w.sums.resize(n), w.rests.resize(n), w.heights.resize(n), w.tiles.resize(n);
  w.sheet = sheet_.make_workspace();
  return w;
}

std::size_t HeightCorrection::memory() const {
  return lattice_.memory() + sheet_.memory() + bytes(ranks_);
}

// Returns how far heights lie above and below the lattice's own in the cells around a node.
Lattice::Extent HeightCorrection::rest_around(std::size_t node, const Workspace& w) const {
  Lattice::Extent rest{infinity, -infinity};
  lattice_.each_cell(node, [&](std::size_t cell, std::size_t) {
    rest.lowest = std::min(rest.lowest, w.rests[cell].lowest);
    rest.highest = std::max(rest.highest, w.rests[cell].highest);
  });
  return rest;
}

void HeightCorrection::set_limits(float height, float pull, Workspace& w) const {
  solver::ObstacleSolver::Fields& f = w.sheet[0];
  sheet_.each_free_node([&](Index n) {
    f.lowest[n] = -infinity, f.highest[n] = infinity, f.wanted[n] = 0;
    if (!lattice_.is_reached(n)) return;  // in a gap: there are no heights to limit
    const Lattice::Extent rest = rest_around(n, w);
    f.lowest[n] = -w.heights[n] - rest.lowest;
    f.highest[n] = height - w.heights[n] - rest.highest;
    if (f.lowest[n] > f.highest[n]) f.lowest[n] = f.highest[n] = (f.lowest[n] + f.highest[n]) / 2;
    f.wanted[n] = pull * (height * ranks_[n] - w.heights[n]);
  });
}

template <typename Real>
void HeightCorrection::set_heights(std::span<const Real> heights, Workspace& w) const {
  lattice_.gather(heights, w.sums, w.heights);
  lattice_.compare(heights, w.heights, w.rests);
}

void HeightCorrection::solve(const HeightLimits& limits, Workspace& w) const {
  const double cells = cell_ / (limits.pull_length * side_);
  const auto pull = static_cast<float>(side_ > 0 ? cells * cells : 0);
  set_limits(static_cast<float>(limits.height), pull, w);
  sheet_.solve({pull, static_cast<float>(limits.boundary_stiffness)}, w.sheet);
  lattice_.refine(w.sheet[0].b, w.tiles);
}

template <typename Real>
void HeightCorrection::fit(std::span<const Real> heights, const HeightLimits& limits, Workspace& w) const {
  set_heights(heights, w);
  solve(limits, w);
}

template void HeightCorrection::set_heights(std::span<const float>, Workspace&) const;
template void HeightCorrection::set_heights(std::span<const double>, Workspace&) const;
template void HeightCorrection::fit(std::span<const float>, const HeightLimits&, Workspace&) const;
template void HeightCorrection::fit(std::span<const double>, const HeightLimits&, Workspace&) const;

template <typename Real>
void HeightCorrection::compress_heights(const Heights<Real>& heights, Workspace& workspace) const {
  const std::span<Real> z = heights.values;
  if (!(heights.limits.height > 0)) return;
  fit<Real>(z, heights.limits, workspace);
  // b need not be 0 at the silhouette: w_b makes the sum 0 there.
  parallel_for(z.size(), [&](std::size_t i) {
    z[i] = static_cast<Real>(heights.boundary_weight[i]) * (z[i] + static_cast<Real>(at(i, workspace)));
  });
  const SoftClip<Real> clip(z);
  if (!(clip.span() > 0)) return;
  const Real scale = static_cast<Real>(heights.limits.height) / clip.span();
  parallel_for(z.size(), [&](std::size_t i) { z[i] = scale * clip(z[i]); });
}

template void HeightCorrection::compress_heights(const Heights<float>&, Workspace&) const;
template void HeightCorrection::compress_heights(const Heights<double>&, Workspace&) const;

}  // namespace relievo
