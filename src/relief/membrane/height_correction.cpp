#include "relief/membrane/height_correction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/memory.h"
#include "core/quantile.h"
#include "geometry/edges.h"
#include "geometry/plane.h"
#include "relief/membrane/soft_clip.h"
#include "relievo/core/parallel.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

// The width of a cell is `cell_size` of the longer side, a quarter of the bending length, so that cells
// resolve this length. If points are too sparse for that, the width is `least_cell_size` sampling distances.
constexpr double cell_size = .007, least_cell_size = 2;
// The bending stiffness of a hinge, as a share of the stiffness elsewhere. It is almost 0, but keeps the
// system regular.
constexpr float hinge = .001F;
constexpr float infinity = std::numeric_limits<float>::infinity();
// Nodes are free if their coverage is above `least_coverage`, and have a lower limit above
// `limited_coverage`. Nearer to the silhouette the ties keep the field up. Heights rise steeply there, and
// limits would jump from node to node.
constexpr float least_coverage = 1e-4F, limited_coverage = .9F;
// The tension outside, as a share of the tension inside. It makes the field continue evenly outside.
constexpr float least_tension = .1F;
// The stiffness of a tie per length of silhouette in cells, in units of the tension across a cell.
constexpr float tie_per_cell = .8F;
// The lower limit of the field on the silhouette, as a share of the relief's height. The field falls below
// the limit by about as much, so to about 0.
constexpr float least_at_silhouette = .03F;

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

// Returns, per node, the share of the lattice around it that the surface covers. The share is 1/2 on the
// silhouette and rises smoothly to 1 within two cells, wherever the silhouette passes between the nodes.
std::vector<float> coverage_of(const Surface& surface, const Lattice& lattice) {
  std::vector<float> coverage(lattice.nodes());
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t) {
    if (!surface.boundary.is_inside[t]) continue;
    const Triangle& c = surface.triangulation.triangles[t];
    const Vec2 p = lattice.place(c[0]), u = lattice.place(c[1]) - p, v = lattice.place(c[2]) - p;
    lattice.spread(p + (u + v) / 3, static_cast<float>(cross(u, v) / 2), coverage);
  }
  return coverage;
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

// Returns the tension per node: the harmonic mean of the jump weights used in (9). More tension would smear
// the misfit, which (9) concentrates at depth jumps.
std::vector<float> tension_of(std::span<const float> weights, const Lattice& lattice) {
  std::vector<float> compliance(weights.size()), tension(lattice.nodes());
  for (std::size_t i = 0; i < compliance.size(); ++i) compliance[i] = 1 / weights[i];
  std::vector<Lattice::Corners> sums(lattice.nodes());
  lattice.gather(std::span<const float>(compliance), sums, tension);
  for (std::size_t n = 0; n < tension.size(); ++n) tension[n] = lattice.is_reached(n) ? 1 / tension[n] : 1;
  return tension;
}

// Returns the edges that belong to only one triangle inside the relief.
std::vector<TriangleSide> silhouette_edges(const Surface& surface) {
  const auto is_inside = [&](const TriangleSide& side) {
    const Boundary& boundary = surface.boundary;
    return boundary.is_inside[side.triangle] && boundary.is_boundary[side.from] &&
           boundary.is_boundary[side.to];
  };
  std::vector<TriangleSide> edges;
  each_edge(surface.triangulation.triangles, is_inside, [&](std::span<const TriangleSide> sides) {
    if (sides.size() == 1) edges.push_back(sides[0]);
  });
  return edges;
}

// Returns a tie for each cell that the silhouette crosses. The tie lies in the middle of the part of the
// silhouette in that cell, and its stiffness is proportional to the part's length.
std::vector<solver::Tie> silhouette_ties(const Surface& surface, const Lattice& lattice) {
  std::vector<solver::Tie> ties;
  std::vector<Index> tie_of(lattice.nodes(), no_index);
  for (const TriangleSide& edge : silhouette_edges(surface)) {
    const Vec2 from = lattice.place(edge.low()), to = lattice.place(edge.high()), middle = (from + to) / 2;
    const Vec2 corner = middle.array().floor();
    const auto length = static_cast<float>((to - from).norm());
    if (!(length > 0)) continue;
    const std::size_t cell =
        static_cast<std::size_t>(corner.x()) + lattice.width() * static_cast<std::size_t>(corner.y());
    if (tie_of[cell] == no_index) {
      tie_of[cell] = static_cast<Index>(ties.size());
      ties.push_back({cell, Vec2f::Zero(), 0});
    }
    solver::Tie& tie = ties[tie_of[cell]];
    tie.stiffness += tie_per_cell * length;
    tie.at += tie_per_cell * length / tie.stiffness * ((middle - corner).cast<float>() - tie.at);
  }
  return ties;
}

// Returns the bending stiffness and the tension of the nodes, which fade with the coverage. The field is
// hinged at silhouettes and depth jumps.
solver::Stiffness stiffness_of(const Surface& surface, std::span<const float> weights, const Lattice& lattice,
                               std::span<const float> coverage) {
  const std::vector<std::uint8_t> jump = is_at_jump(surface, lattice);
  const Scale scale(surface.longer_side(), surface.rho);
  const float stiff = scale.in_cells_squared(HeightCorrection::bending_length);
  solver::Stiffness s{std::vector<float>(lattice.nodes()), tension_of(weights, lattice)};
  for (std::size_t n = 0; n < coverage.size(); ++n) {
    s.tension[n] *= std::clamp(coverage[n], least_tension, 1.F);
    if (coverage[n] <= least_coverage) continue;
    const float inside = std::clamp(2 * coverage[n] - 1, 0.F, 1.F);
    s.bending[n] = stiff * (jump[n] ? hinge : std::max(hinge, inside * inside * (3 - 2 * inside)));
  }
  return s;
}

}  // namespace

std::size_t HeightCorrection::Workspace::memory() const {
  std::size_t sum = bytes(sums) + bytes(rests) + bytes(heights) + bytes(tiles);
  for (const solver::ObstacleSolver::Fields& fields : sheet) sum += fields.memory();
  return sum;
}

// Strong compression needs all of the height, so the relief may then stand off the base at the silhouette.
// The boundary stiffness falls from 1 at a height share of 1 to 0.1 at 0.775. See
// docs/decisions/height-correction.md.
HeightLimits HeightLimits::of(double height, const MembraneParams& params) {
  constexpr double least = .1, fall = 4;
  return {height, params.pull_length, std::max(1 - fall * (1 - params.height_share), least)};
}

HeightCorrection::HeightCorrection(const Surface& surface, std::span<const float> jump_weights)
    : side_(surface.longer_side()),
      cell_(Scale(side_, surface.rho).cell),
      lattice_(surface.points, free_points(surface.boundary), cell_),
      coverage_(coverage_of(surface, lattice_)),
      sheet_(lattice_.width(), stiffness_of(surface, jump_weights, lattice_, coverage_),
             silhouette_ties(surface, lattice_)),
      ranks_(lattice_.nodes()) {
  std::vector<Lattice::Corners> sums(lattice_.nodes());
  std::vector<double> depths;
  for (const Vec3& p : surface.points) depths.push_back(p.z());
  depths = ranks(depths);
  lattice_.gather(std::span<const double>(depths), sums, ranks_);
}

HeightCorrection::Workspace HeightCorrection::make_workspace() const {
  Workspace w;
  const std::size_t n = lattice_.nodes();
  w.sums.resize(n), w.rests.resize(n), w.heights.resize(n), w.tiles.resize(n);
  w.sheet = sheet_.make_workspace();
  return w;
}

std::size_t HeightCorrection::memory() const {
  return lattice_.memory() + sheet_.memory() + bytes(ranks_) + bytes(coverage_);
}

// Returns by how much, in the cells around a node, the heights of points lie above and below the heights
// interpolated from the lattice.
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
    if (coverage_[n] > limited_coverage) f.lowest[n] = -w.heights[n] - rest.lowest;
    f.highest[n] = height - w.heights[n] - rest.highest;
    if (f.lowest[n] > f.highest[n]) f.lowest[n] = f.highest[n] = (f.lowest[n] + f.highest[n]) / 2;
    f.wanted[n] = coverage_[n] * pull * (height * ranks_[n] - w.heights[n]);
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
  const auto height = static_cast<float>(limits.height);
  set_limits(height, pull, w);
  sheet_.solve({pull, static_cast<float>(limits.boundary_stiffness), least_at_silhouette * height}, w.sheet);
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
  if (!(heights.limits.height > 0) || std::ranges::all_of(z, [](Real height) { return height == 0; })) return;
  fit<Real>(z, heights.limits, workspace);
  // (9) gives 0 at the silhouette, but b need not be 0 there, so b is multiplied by w_b. Points that stay
  // below the base are raised to it. They are few, but would take height from all other points.
  parallel_for(z.size(), [&](std::size_t i) {
    z[i] += static_cast<Real>(heights.boundary_weight[i]) * static_cast<Real>(at(i, workspace));
    z[i] = std::max(z[i], Real(0));
  });
  const SoftClip<Real> clip(z);
  if (!(clip.span() > 0)) return;
  const Real scale = static_cast<Real>(heights.limits.height) / clip.span();
  parallel_for(z.size(), [&](std::size_t i) { z[i] = scale * clip(z[i]); });
}

template void HeightCorrection::compress_heights(const Heights<float>&, Workspace&) const;
template void HeightCorrection::compress_heights(const Heights<double>&, Workspace&) const;

}  // namespace relievo
