#include "solver/dissection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/lists.h"
#include "core/quantile.h"

namespace relievo::solver {
namespace {

// The share of the vertices that is assigned to each side in advance. The remaining 30 % in the middle form
// the band in which the separator is sought. A wider band allows a shorter separator, but the sizes of the
// sides can then differ more.
constexpr double core_share = .35;

// The positions of the vertices along a direction, and the limits of the band.
struct Sweep {
  Eigen::Vector2f direction = {1, 0};
  std::vector<float> value;
  float low = 0, high = 0;
};

bool is_in_band(const Sweep& sweep, Index v) {
  return sweep.value[v] >= sweep.low && sweep.value[v] <= sweep.high;
}

// Sets the limits of the band. Quantiles of a sample of about 1,024 vertices are accurate enough, because the
// flow finds the best separator within the band.
void find_band(Sweep& sweep) {
  const std::size_t most = 1024, n = sweep.value.size(), step = (n + most - 1) / most;
  std::vector<float> sample;
  for (std::size_t i = 0; i < n; i += step) sample.push_back(sweep.value[i]);
  const auto quantile = [&](double share) {
    return value_of_rank(std::span(sample),
                         static_cast<std::size_t>(share * static_cast<double>(sample.size())));
  };
  sweep.low = quantile(core_share);
  sweep.high = quantile(1 - core_share);
}

Sweep make_sweep(std::vector<float> value, const Eigen::Vector2f& direction) {
  Sweep sweep{direction, std::move(value)};
  find_band(sweep);
  return sweep;
}

// Returns the direction in which the positions spread most: the principal axis of their covariance.
// Separators perpendicular to it are usually short. If the positions spread equally in all directions,
// rounding decides. The result is still the same on every machine, because sums, quotients and square roots
// have the same bits everywhere.
Eigen::Vector2f widest_direction(std::span<const Eigen::Vector2f> positions) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2f& p : positions) mean += p.cast<double>();
  mean /= static_cast<double>(positions.size());
  double xx = 0, xy = 0, yy = 0;
  for (const Eigen::Vector2f& p : positions) {
    const Eigen::Vector2d d = p.cast<double>() - mean;
    xx += d.x() * d.x(), xy += d.x() * d.y(), yy += d.y() * d.y();
  }
  const double difference = xx - yy,
               longer = std::abs(difference) + std::sqrt(difference * difference + 4 * xy * xy);
  if (!(longer > 0)) return {1, 0};
  const Eigen::Vector2d axis =
      difference >= 0 ? Eigen::Vector2d(longer, 2 * xy) : Eigen::Vector2d(2 * xy, longer);
  return axis.normalized().cast<float>();
}

Sweep widest_sweep(std::span<const Eigen::Vector2f> positions) {
  const Eigen::Vector2f direction = widest_direction(positions);
  std::vector<float> value(positions.size());
  for (std::size_t i = 0; i < value.size(); ++i) value[i] = positions[i].dot(direction);
  return make_sweep(std::move(value), direction);
}

SeparatorBand make_band(const Graph& graph, std::span<const Eigen::Vector2f> positions, const Sweep& sweep,
                        const std::vector<Index>& vertices) {
  const std::vector<Index> slot = places_in(vertices, graph.size());
  SeparatorBand band;
  band.direction = sweep.direction;
  band.positions = pick(positions, vertices);
  band.graph.begin.reserve(vertices.size() + 1);
  band.graph.to.reserve(vertices.size() * 6);
  band.touches_first.assign(vertices.size(), 0);
  band.touches_second.assign(vertices.size(), 0);
  for (Index i = 0; i < vertices.size(); ++i) {
    for (const Index u : graph.neighbours(vertices[i])) {
      if (slot[u] != no_index)
        band.graph.to.push_back(slot[u]);
      else
        (sweep.value[u] < sweep.low ? band.touches_first : band.touches_second)[i] = 1;
    }
    band.graph.begin.push_back(static_cast<Index>(band.graph.to.size()));
  }
  return band;
}

void count_sides(Bisection& cut) {
  cut.first = cut.second = cut.separator = 0;
  for (const Side s : cut.side)
    ++(s == Side::first ? cut.first : s == Side::second ? cut.second : cut.separator);
}

// Edges that cross the whole band are not in the band's graph, so they may still connect the two sides. Each
// such edge has one end on the first side. Moves this end to the separator.
void close_gaps(const Graph& graph, Bisection& cut) {
  for (Index v = 0; v < graph.size(); ++v) {
    if (cut.side[v] != Side::first) continue;
    const auto nearby = graph.neighbours(v);
    if (std::any_of(nearby.begin(), nearby.end(), [&](Index u) { return cut.side[u] == Side::second; }))
      cut.side[v] = Side::separator;
  }
  count_sides(cut);
}

// Estimates the number of factor entries that a bisection causes. A separator of s vertices is eliminated as
// a dense triangle of s^2 / 2 entries. Each row below the triangle adds s entries; on average there are 2.2
// sqrt(n) such rows. Sides of unequal size cause 2 n (1 - H) more entries than equal ones; H is the entropy
// of the split in bits. See docs/decisions/solver.md.
double cost(const Bisection& cut) {
  if (cut.first == 0 || cut.second == 0) return std::numeric_limits<double>::infinity();
  const double n = static_cast<double>(cut.side.size()), s = cut.separator;
  const double a = cut.first / n, b = cut.second / n;
  const double unevenness = 1 + a * std::log2(a) + b * std::log2(b);
  return s * (s / 2 + 2.2 * std::sqrt(n)) + 2 * n * unevenness;
}

Bisection with_band(const Sweep& sweep, const std::vector<Index>& vertices, const std::vector<Side>& sides) {
  Bisection cut;
  cut.side.resize(sweep.value.size());
  for (Index v = 0; v < cut.side.size(); ++v)
    cut.side[v] = sweep.value[v] < sweep.low ? Side::first : Side::second;
  for (std::size_t i = 0; i < vertices.size(); ++i) cut.side[vertices[i]] = sides[i];
  count_sides(cut);
  return cut;
}

Bisection cut_along(const Graph& graph, std::span<const Eigen::Vector2f> positions, const Sweep& sweep) {
  const auto vertices = indices_where(graph.size(), [&](Index v) { return is_in_band(sweep, v); });
  const MinimumSeparators cuts = minimum_separators(make_band(graph, positions, sweep, vertices));
  Bisection a = with_band(sweep, vertices, cuts.near_first), b = with_band(sweep, vertices, cuts.near_second);
  Bisection& better = cost(a) <= cost(b) ? a : b;
  close_gaps(graph, better);
  return std::move(better);
}

// Returns the vertices in breadth-first order from `start`, one connected component after the other.
std::vector<Index> wave(const Graph& graph, Index start) {
  std::vector<Index> order;
  std::vector<std::uint8_t> is_seen(graph.size(), 0);
  order.reserve(graph.size());
  for (Index i = 0; i < graph.size(); ++i) {
    const Index root = (start + i) % graph.size();
    if (is_seen[root]) continue;
    is_seen[root] = 1;
    order.push_back(root);
    for (std::size_t head = order.size() - 1; head < order.size(); ++head)
      for (const Index u : graph.neighbours(order[head]))
        if (!is_seen[u]) {
          is_seen[u] = 1;
          order.push_back(u);
        }
  }
  return order;
}

// Bisects by the order in which a breadth-first search visits the vertices. This order replaces a coordinate.
// The search starts at a vertex at the rim of the graph.
Bisection cut_by_distance(const Graph& graph, std::span<const Eigen::Vector2f> positions) {
  const std::vector<Index> order = wave(graph, wave(graph, 0).back());
  std::vector<float> value(graph.size());
  for (std::size_t i = 0; i < order.size(); ++i) value[order[i]] = static_cast<float>(i);
  return cut_along(graph, positions, make_sweep(std::move(value), {1, 0}));
}

}  // namespace

Bisection bisect(const Graph& graph, std::span<const Eigen::Vector2f> positions) {
  Bisection cut = cut_along(graph, positions, widest_sweep(positions));
  // A planar graph has a separator of about sqrt(n) vertices (Lipton and Tarjan 1979). If the separator has
  // four times as many, the positions do not fit the graph.
  if (cut.separator > 4 * std::sqrt(static_cast<double>(graph.size())) || cut.first == 0 || cut.second == 0) {
    Bisection other = cut_by_distance(graph, positions);
    if (cost(other) < cost(cut)) return other;
  }
  return cut;
}

}  // namespace relievo::solver
