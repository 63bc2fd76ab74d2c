#include "relief/correction/height_correction.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/lists.h"
#include "core/memory.h"
#include "geometry/edges.h"
#include "geometry/plane.h"
#include "relief/correction/soft_clip.h"
#include "relievo/core/parallel.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

// The width of a lattice cell is `cell_size` of the longer side, but at least `least_cell_size` sampling distances.
// `cell_size` is a seventh of the bending length, so that the lattice can represent fields that bend over this length.
constexpr double cell_size = .007, least_cell_size = 2;
// The bending stiffness of a hinge, as a share of the stiffness elsewhere. It is not 0, because the system
// would then be singular.
constexpr float hinge = .001F;
constexpr float infinity = std::numeric_limits<float>::infinity();
// Nodes are free if their coverage is above `least_coverage`. The field has a lower limit at nodes whose
// coverage is above `limited_coverage`. Nearer to the silhouette, heights rise steeply, so the lower limits
// of neighbouring nodes would differ widely. There, ties (springs along the silhouette) hold the field
// instead.
constexpr float least_coverage = 1e-4F, limited_coverage = .9F;
// The least tension, as a share of the tension inside the silhouette. With this tension, the field continues
// smoothly outside the silhouette.
constexpr float least_tension = .1F;
// The stiffness of a tie is `tie_per_cell` times the length of the silhouette within the tie's cell, in cell
// widths. The unit of stiffness is the tension across a cell.
constexpr float tie_per_cell = .8F;
// Parameters of the forces that keep nearer parts higher than farther parts beside them (near order,
// docs/decisions/near-order.md). `pair_distances` are the distances of paired nodes, as shares of the longer
// side. Let the depths of a pair differ by d, as a share of the depth range. Then the nearer node should be
// higher by `largest_step` * tanh(d / `large_difference`), as a share of the relief's height.
// `order_stiffness` is in units of the tension across a cell of `cell_size`. The forces fade out at the
// silhouette, where the relief stands off the base anyway.
constexpr std::array<double, 2> pair_distances{.05, .09};
constexpr double large_difference = .03;
constexpr float largest_step = .4F, order_stiffness = .02F;

std::vector<Index> free_points(const Boundary& boundary) {
  return indices_where(boundary.is_boundary.size(), [&](Index i) { return !boundary.is_boundary[i]; });
}

struct Scale {
  double side, cell;

  Scale(double longer_side, double rho)
      : side(longer_side), cell(side > 0 ? std::max(cell_size * side, least_cell_size * rho) : 1) {}

  // Converts a length from a share of the longer side to a number of cells, and returns the square of this
  // number. Returns 0 for a surface without extent.
  float in_cells_squared(double of_side) const {
    return static_cast<float>(std::pow(of_side * side / cell, 2));
  }
};

// Returns, per node, the share of the lattice around it that the surface covers. The share is 1/2 on the silhouette and
// rises smoothly to 1 within two cells. It does not depend on where the silhouette passes between the nodes.
std::vector<float> coverage_of(const Surface& surface, const Lattice& lattice) {
  std::vector<float> coverage(lattice.nodes());
  for (const Triangle c : triangles_inside(surface)) {
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

// Returns a tie for each cell that the silhouette crosses. The tie is attached at the middle of the
// part of the silhouette within the cell. Its stiffness is proportional to the length of this part.
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

// Returns a smooth function of the coverage: 0 outside and on the silhouette, 1 inside.
float inside_of(float coverage) {
  const float inside = std::clamp(2 * coverage - 1, 0.F, 1.F);
  return inside * inside * (3 - 2 * inside);
}

// Returns the bending stiffness and the tension of the nodes, which fade with the coverage. The field is
// hinged at silhouettes and depth jumps.
solver::Stiffness stiffness_of(const Surface& surface, const Lattice& lattice,
                               std::span<const float> coverage) {
  const std::vector<std::uint8_t> jump = is_at_jump(surface, lattice);
  const Scale scale(surface.longer_side(), surface.rho);
  const float stiff = scale.in_cells_squared(HeightCorrection::bending_length);
  solver::Stiffness s{std::vector<float>(lattice.nodes()), std::vector<float>(lattice.nodes())};
  for (std::size_t n = 0; n < coverage.size(); ++n) {
    s.tension[n] = std::clamp(coverage[n], least_tension, 1.F);
    if (coverage[n] <= least_coverage) continue;
    s.bending[n] = stiff * (jump[n] ? hinge : std::max(hinge, inside_of(coverage[n])));
  }
  return s;
}

}  // namespace

std::size_t HeightCorrection::Workspace::memory() const {
  std::size_t sum = bytes(sums) + bytes(rests) + bytes(heights) + bytes(tiles);
  for (const solver::ObstacleSolver::Fields& fields : sheet) sum += fields.memory();
  return sum;
}

// Returns limits whose boundary stiffness depends on the height share. The stiffness is 1 at a height share
// of 1, falls linearly to 0.3 at a height share of 0.825, and is 0.3 below that. Strong compression needs all
// of the height, so the relief may then stand off the base at the silhouette
// (docs/decisions/height-correction.md).
HeightLimits HeightLimits::of(double height, const Shape& shape) {
  constexpr double least = .3, fall = 4;
  return {height, std::max(1 - fall * (1 - height_share(shape)), least), shape.planes};
}

namespace {

// Returns the mean depth per node.
std::vector<float> depth_of(const Surface& surface, const Lattice& lattice) {
  std::vector<Lattice::Corners> sums(lattice.nodes());
  std::vector<double> z;
  for (const Vec3& p : surface.points) z.push_back(p.z());
  std::vector<float> depth(lattice.nodes());
  lattice.gather(std::span<const double>(z), sums, depth);
  return depth;
}

float depth_range(const Surface& surface) {
  if (surface.points.empty()) return 0;
  const auto [low, high] = std::ranges::minmax(surface.points, {}, [](const Vec3& p) { return p.z(); });
  return static_cast<float>(high.z() - low.z());
}

solver::ObstacleSolver sheet_of(const Surface& surface, const Lattice& lattice,
                                std::span<const float> coverage) {
  const std::vector<float> depth = depth_of(surface, lattice);
  constexpr float faster = 5;  // the shares fall from 1 at a coverage of 1 to 0 at a coverage of 0.9
  std::vector<float> share(depth.size());
  for (std::size_t n = 0; n < share.size(); ++n)
    share[n] = lattice.is_reached(n) ? inside_of(1 - faster * (1 - coverage[n])) : 0;
  const Scale scale(surface.longer_side(), surface.rho);
  solver::OrderedPairs pairs;
  if (const float range = depth_range(surface); range > 0) {
    pairs = {depth, share, static_cast<float>(large_difference) * range, {}};
    for (const double distance : pair_distances)
      pairs.distances.push_back(static_cast<float>(distance * scale.side / scale.cell));
  }
  return {lattice.width(), stiffness_of(surface, lattice, coverage), silhouette_ties(surface, lattice),
          pairs};
}

}  // namespace

HeightCorrection::HeightCorrection(const Surface& surface)
    : side_(surface.longer_side()),
      cell_(Scale(side_, surface.rho).cell),
      lattice_(surface.points, free_points(surface.boundary), cell_),
      coverage_(coverage_of(surface, lattice_)),
      sheet_(sheet_of(surface, lattice_, coverage_)) {}

HeightCorrection::Workspace HeightCorrection::make_workspace() const {
  Workspace w;
  const std::size_t n = lattice_.nodes();
  w.sums.resize(n), w.rests.resize(n), w.heights.resize(n), w.tiles.resize(n);
  w.sheet = sheet_.make_workspace();
  return w;
}

std::size_t HeightCorrection::memory() const {
  return lattice_.memory() + sheet_.memory() + bytes(coverage_);
}

// Compares the heights of the points in the cells around a node with the heights interpolated from the
// lattice. Returns the range of the differences.
Lattice::Extent HeightCorrection::rest_around(std::size_t node, const Workspace& w) const {
  Lattice::Extent rest{infinity, -infinity};
  lattice_.each_cell(node, [&](std::size_t cell, std::size_t) {
    rest.lowest = std::min(rest.lowest, w.rests[cell].lowest);
    rest.highest = std::max(rest.highest, w.rests[cell].highest);
  });
  return rest;
}

void HeightCorrection::set_limits(float height, Workspace& w) const {
  solver::ObstacleSolver::Fields& f = w.sheet[0];
  std::ranges::copy(w.heights, f.heights.begin());
  sheet_.each_free_node([&](Index n) {
    f.lowest[n] = -infinity, f.highest[n] = infinity;
    if (!lattice_.is_reached(n)) return;  // no point is near this node, so there are no heights to limit
    const Lattice::Extent rest = rest_around(n, w);
    if (coverage_[n] > limited_coverage) f.lowest[n] = -w.heights[n] - rest.lowest;
    f.highest[n] = height - w.heights[n] - rest.highest;
    if (f.lowest[n] > f.highest[n]) f.lowest[n] = f.highest[n] = (f.lowest[n] + f.highest[n]) / 2;
  });
}

template <typename Real>
void HeightCorrection::fit(std::span<const Real> heights, const HeightLimits& limits, Workspace& w) const {
  lattice_.gather(heights, w.sums, w.heights);
  lattice_.compare(heights, w.heights, w.rests);
  const auto height = static_cast<float>(limits.height);
  set_limits(height, w);
  solver::Springs springs{static_cast<float>(limits.boundary_stiffness),
                          static_cast<float>(limits.planes) * height};
  // A lattice with wider cells has fewer pairs per area, so each pair is stiffer.
  const auto wider = static_cast<float>(side_ > 0 ? cell_ / (cell_size * side_) : 1);
  springs.order = {largest_step * height, order_stiffness * wider * wider};
  sheet_.solve(springs, w.sheet);
  lattice_.refine(w.sheet[0].b, w.tiles);
}

template void HeightCorrection::fit(std::span<const float>, const HeightLimits&, Workspace&) const;
template void HeightCorrection::fit(std::span<const double>, const HeightLimits&, Workspace&) const;

template <typename Real>
void HeightCorrection::compress_heights(const Heights<Real>& heights, Workspace& workspace) const {
  const std::span<Real> z = heights.values;
  if (!(heights.limits.height > 0) || std::ranges::all_of(z, [](Real height) { return height == 0; })) return;
  fit<Real>(z, heights.limits, workspace);
  // Equation (9) gives height 0 at the silhouette, but b need not be 0 there, so b is multiplied by w_b. The
  // few points that stay below the base are raised to it. Otherwise the scaling below would lower all other
  // heights to make room for them.
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
