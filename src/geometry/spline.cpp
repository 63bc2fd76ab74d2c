// Section and equation numbers are those of Lee, Wolberg and Shin, 1997.
#include "relievo/geometry/spline.h"

#include <algorithm>
#include <cmath>

#include "core/simd.h"
#include "geometry/cubic_stencil.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Computes a node of the refined lattice (section 4). At an even position it depends on three nodes of the
// coarser lattice, at an odd position on two.
float halved(const float* node, bool is_even) {
  return is_even ? .125F * (node[0] + node[2]) + .75F * node[1] : .5F * (node[0] + node[1]);
}

// Returns the values of cubic_basis(), each one twice, because the nodes of two splines are interleaved.
RELIEVO_INLINE Float8 basis_of(Float8 t) {
  const Float8 c0{1 / 6.F, 1 / 6.F, 4 / 6.F, 4 / 6.F, 1 / 6.F, 1 / 6.F, 0, 0},
      c1{-.5F, -.5F, 0, 0, .5F, .5F, 0, 0}, c2{.5F, .5F, -1, -1, .5F, .5F, 0, 0},
      c3{-1 / 6.F, -1 / 6.F, .5F, .5F, -.5F, -.5F, 1 / 6.F, 1 / 6.F};
  return c0 + t * (c1 + t * (c2 + t * c3));
}

struct PairInput {
  const float* nodes;
  std::size_t columns;
  std::span<const SplinePlace> places;
};

RELIEVO_INLINE void evaluate_pairs(const PairInput& input, const MultilevelSpline::PairValues& values) {
  for (std::size_t i = 0; i < input.places.size(); ++i) {
    const SplinePlace place = input.places[i];
    const Float8 x = basis_of(Float8{} + unpacked_share(place.x));
    const Float8 y = basis_of(Float8{} + unpacked_share(place.y));
    const float* node = input.nodes + 2 * std::size_t{place.node};
    Float8 sum{};
    for (int l = 0; l < 4; ++l, node += 2 * input.columns)
      sum += y[2 * l] * *reinterpret_cast<const Float8*>(node);
    sum *= x;
    const Float4 halves =
        __builtin_shufflevector(sum, sum, 0, 1, 2, 3) + __builtin_shufflevector(sum, sum, 4, 5, 6, 7);
    values.a[i] = halves[0] + halves[2];
    values.b[i] = halves[1] + halves[3];
  }
}

}  // namespace

MultilevelSpline::MultilevelSpline(std::span<const Vec2> sites, std::span<const float> weights,
                                   const SplineOptions& options)
    : min_(options.min), max_(options.max), weights_(weights.begin(), weights.end()) {
  for (const float weight : weights_) total_weight_ += static_cast<double>(weight);
  const double damping =
      sites.empty() ? 0 : options.damping * total_weight_ / static_cast<double>(sites.size());
  const int coarsest = options.levels - 1;
  const auto cells = [&](double length) {
    return static_cast<std::size_t>(std::max(1.0, std::ceil(std::ldexp(length / options.cell, -coarsest))));
  };
  // All lattices cover whole cells of the coarsest one, so that each lattice refines the previous one
  // exactly.
  const Vec2 size = max_ - min_;
  levels_.resize(static_cast<std::size_t>(options.levels));
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    Level& level = levels_[i];
    level.columns = (cells(size.x()) << i) + 3;
    level.rows = (cells(size.y()) << i) + 3;
    level.cell = std::ldexp(options.cell, coarsest - static_cast<int>(i));
    const int number = static_cast<int>(i);
    if (number >= options.first_fitted && number <= options.last_fitted) prepare(level, sites, damping);
  }
}

MultilevelSpline::Position MultilevelSpline::locate(const Level& level, const Vec2& point) const {
  const Vec2 at = (point.cwiseMax(min_).cwiseMin(max_) - min_) / level.cell;
  const auto column = std::min(static_cast<std::size_t>(at.x()), level.columns - 4);
  const auto row = std::min(static_cast<std::size_t>(at.y()), level.rows - 4);
  return {static_cast<Index>(row * level.columns + column),
          static_cast<float>(at.x() - static_cast<double>(column)),
          static_cast<float>(at.y() - static_cast<double>(row))};
}

// Precomputes the parts of a level's fit that do not depend on the values: the basis functions at each site,
// and the sum of the weights around each node.
void MultilevelSpline::prepare(Level& level, std::span<const Vec2> sites, double damping) const {
  std::vector<double> weight(level.columns * level.rows, damping);
  level.sites.resize(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Position at = locate(level, sites[i]);
    Site& site = level.sites[i] = {cubic_basis(at.x), cubic_basis(at.y), at.node};
    const CubicRow wx = site.x.square(), wy = site.y.square();
    site.scale = weights_[i] / (wx.sum() * wy.sum());
    for (int l = 0; l < 4; ++l)
      for (int k = 0; k < 4; ++k)
        weight[site.node + static_cast<std::size_t>(l) * level.columns + static_cast<std::size_t>(k)] +=
            static_cast<double>(weights_[i]) * static_cast<double>(wx[k] * wy[l]);
  }
  level.inverse.resize(weight.size());
  for (std::size_t i = 0; i < weight.size(); ++i)
    level.inverse[i] = weight[i] > 0 ? static_cast<float>(1 / weight[i]) : 0;
}

std::size_t MultilevelSpline::memory() const {
  std::size_t sum = weights_.size() * sizeof(float);
  for (const Level& level : levels_)
    sum += level.sites.size() * sizeof(Site) + level.inverse.size() * sizeof(float);
  return sum;
}

SplineFunction MultilevelSpline::make_function() const {
  return {0, std::vector<float>(levels_.back().columns * levels_.back().rows)};
}

MultilevelSpline::Workspace MultilevelSpline::make_workspace() const {
  const std::size_t nodes = levels_.back().columns * levels_.back().rows;
  return {std::vector<float>(weights_.size()), std::vector<float>(nodes), std::vector<float>(nodes)};
}

void MultilevelSpline::fit(std::span<const float> values, SplineFunction& function,
                           Workspace& workspace) const {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    sum += static_cast<double>(weights_[i]) * static_cast<double>(values[i]);
  function.mean = total_weight_ > 0 ? static_cast<float>(sum / total_weight_) : 0;
  for (std::size_t i = 0; i < values.size(); ++i) workspace.rest[i] = values[i] - function.mean;
  std::fill(function.nodes.begin(), function.nodes.end(), 0.F);
  // Each level fits the residual that the coarser levels leave (section 4). First, the sum of the coarser
  // levels is refined to the lattice of this level.
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    if (i > 0) refine(levels_[i - 1], function.nodes, workspace.coarser);
    if (!levels_[i].sites.empty()) correct(levels_[i], function.nodes, workspace);
  }
}

void MultilevelSpline::refine(const Level& coarse, std::vector<float>& nodes, std::vector<float>& copy) {
  std::copy_n(nodes.begin(), coarse.columns * coarse.rows, copy.begin());
  const std::size_t columns = 2 * coarse.columns - 3, rows = 2 * coarse.rows - 3;
  // The first node of each lattice lies outside the domain by the width of one cell of the same lattice. So a
  // node of the finer lattice coincides with a node of the coarser one where c and r are odd. The paper calls
  // these positions even.
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < columns; ++c) {
      const float* node = copy.data() + (r / 2) * coarse.columns + c / 2;
      const auto across = [&](std::size_t k) { return halved(node + k * coarse.columns, c % 2 == 1); };
      const float low[3] = {across(0), across(1), r % 2 == 1 ? across(2) : 0};
      nodes[r * columns + c] = halved(low, r % 2 == 1);
    }
  }
}

// Corrects the nodes so that the spline fits the residuals at the sites. The correction follows equations (3) to (5)
// of section 3.2, with a weight per site.
void MultilevelSpline::correct(const Level& level, std::vector<float>& nodes, Workspace& workspace) const {
  std::vector<float>& correction = workspace.correction;
  const std::size_t columns = level.columns, size = columns * level.rows;
  std::fill_n(correction.begin(), size, 0.F);
  for (std::size_t i = 0; i < level.sites.size(); ++i) {
    const Site& site = level.sites[i];
    const CubicRow x_part = site.x.cube() * (site.scale * workspace.rest[i]), y_part = site.y.cube();
    for (int l = 0; l < 4; ++l)
      Eigen::Map<CubicRow>(&correction[site.node + static_cast<std::size_t>(l) * columns]) +=
          y_part[l] * x_part;
  }
  for (std::size_t i = 0; i < size; ++i) nodes[i] += correction[i] *= level.inverse[i];
  for (std::size_t i = 0; i < level.sites.size(); ++i) {
    const Site& site = level.sites[i];
    workspace.rest[i] -= CubicStencil{site.x, site.y}(&correction[site.node], columns);
  }
}

std::vector<SplinePlace> MultilevelSpline::pack(std::span<const Vec2> points) const {
  std::vector<SplinePlace> places(points.size());
  parallel_for(points.size(), [&](std::size_t i) {
    const Position at = locate(levels_.back(), points[i]);
    places[i] = {at.node, packed_share(at.x), packed_share(at.y)};
  });
  return places;
}

void MultilevelSpline::evaluate(const SplineFunction& function, std::span<const SplinePlace> places,
                                std::span<float> values) const {
  const std::size_t columns = levels_.back().columns;
  parallel_for(places.size(), [&](std::size_t i) {
    values[i] = function.mean + cubic_stencil(places[i])(&function.nodes[places[i].node], columns);
  });
}

void MultilevelSpline::pair_up(const SplineFunction& a, const SplineFunction& b, std::vector<float>& pair) {
  pair.resize(2 * a.nodes.size());
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    pair[2 * i] = a.nodes[i];
    pair[2 * i + 1] = b.nodes[i];
  }
}

void MultilevelSpline::evaluate(std::span<const float> pair, std::span<const SplinePlace> places,
                                const PairValues& values) const {
  const PairInput input{pair.data(), levels_.back().columns, places};
  RELIEVO_WIDE(evaluate_pairs(input, values));
}

}  // namespace relievo
