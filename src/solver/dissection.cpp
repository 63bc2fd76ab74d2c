#include "solver/dissection.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "relievo/core/parallel.h"
#include "solver/bisection.h"
#include "solver/minimum_degree.h"

namespace relievo::solver {
namespace {

// For parts of at most this many vertices minimum degree finds a better order than another cut, and faster.
constexpr Index leaf_size = 120;

struct Part {
  Graph graph;
  std::vector<Eigen::Vector2f> positions;
  std::vector<Index> vertices;  // numbers of the vertices in the whole graph
  Index begin = 0;              // where this part begins in the elimination order
};

// Returns the vertices of one side and the edges among them.
Part extract(const Part& part, const Bisection& cut, Side side) {
  Part result;
  std::vector<Index> slot(part.graph.size());
  for (Index v = 0; v < part.graph.size(); ++v) {
    if (cut.side[v] != side) continue;
    slot[v] = static_cast<Index>(result.vertices.size());
    result.vertices.push_back(part.vertices[v]);
    result.positions.push_back(part.positions[v]);
  }
  result.graph.begin.reserve(result.vertices.size() + 1);
  result.graph.to.reserve(result.vertices.size() * 6);
  for (Index v = 0; v < part.graph.size(); ++v) {
    if (cut.side[v] != side) continue;
    for (const Index u : part.graph.neighbours(v))
      if (cut.side[u] == side) result.graph.to.push_back(slot[u]);
    result.graph.begin.push_back(static_cast<Index>(result.graph.to.size()));
  }
  return result;
}

class Dissection {
 public:
  Dissection(const Graph& graph, std::vector<Index>& order)
      : graph_(graph), order_(order), slots_(graph.size(), no_index) {}

  // Bisects level by level while parts are large, so that the parts of a level are cut concurrently, and
  // orders the many small parts concurrently afterwards. Whether a part is large depends on sizes alone, so
  // that the result does not depend on the number of threads.
  void run(Part whole) {
    const Index small = std::max<Index>(2048, whole.graph.size() / 32);
    std::vector<Part> large, pieces;
    large.push_back(std::move(whole));
    while (!large.empty()) {
      std::vector<std::array<Part, 2>> halves(large.size());
      parallel_for(
          large.size(), [&](std::size_t i) { halves[i] = split(large[i]); }, 1);
      large.clear();
      for (auto& pair : halves)
        for (Part& part : pair) (part.graph.size() > small ? large : pieces).push_back(std::move(part));
    }
    parallel_for(
        pieces.size(), [&](std::size_t i) { dissect(std::move(pieces[i])); }, 1);
  }

 private:
  // Writes the separator to the end of the part's range in the order and returns the two sides; two empty
  // parts if the part was small and is ordered as a leaf.
  std::array<Part, 2> split(Part& part) {
    if (part.graph.size() <= leaf_size) {
      order_leaf(part);
      return {};
    }
    const Bisection cut = bisect(part.graph, part.positions);
    if (cut.first == 0 || cut.second == 0) {
      order_leaf(part);
      return {};
    }
    Part first = extract(part, cut, Side::first), second = extract(part, cut, Side::second);
    first.begin = part.begin;
    second.begin = part.begin + cut.first;
    Index next = second.begin + cut.second;
    for (Index v = 0; v < part.graph.size(); ++v)
      if (cut.side[v] == Side::separator) order_[next++] = part.vertices[v];
    part = {};
    return {std::move(first), std::move(second)};
  }

  void dissect(Part part) {
    if (part.graph.size() == 0) return;
    for (Part& half : split(part)) dissect(std::move(half));
  }

  void order_leaf(const Part& part) {
    const std::span<Index> places = std::span(order_).subspan(part.begin, part.vertices.size());
    std::copy(part.vertices.begin(), part.vertices.end(), places.begin());
    // The bit sets of MinimumDegree grow with the square of the size (2 MB at 4,096). A larger part that
    // resists every cut, such as a complete graph, keeps the order it has.
    constexpr std::size_t largest_leaf = 4096;
    if (places.size() <= largest_leaf) MinimumDegree(graph_, slots_).order(places);
  }

  const Graph& graph_;
  std::vector<Index>& order_;
  std::vector<Index> slots_;
};

// Returns a substitute for the angle of a vector. It grows with the angle, from 0 to 4, and needs no arc
// tangent.
float pseudo_angle(const Eigen::Vector2f& step) {
  const float sum = std::abs(step.x()) + std::abs(step.y());
  const float turn = sum > 0 ? step.x() / sum : 0;
  return step.y() >= 0 ? 1 - turn : 3 + turn;
}

// Sorts each vertex's neighbours counter-clockwise, as minimum_separators() needs them.
void turn_in_order(Graph& graph, std::span<const Eigen::Vector2f> positions) {
  parallel_ranges(graph.size(), default_grain, [&](std::size_t begin, std::size_t end) {
    std::vector<std::pair<float, Index>> around;
    for (std::size_t v = begin; v < end; ++v) {
      around.clear();
      for (const Index u : graph.neighbours(static_cast<Index>(v)))
        around.emplace_back(pseudo_angle(positions[u] - positions[v]), u);
      std::sort(around.begin(), around.end());
      for (std::size_t i = 0; i < around.size(); ++i) graph.to[graph.begin[v] + i] = around[i].second;
    }
  });
}

}  // namespace

std::vector<Index> dissection_order(const Graph& graph, std::span<const Eigen::Vector2f> positions) {
  std::vector<Index> order(graph.size());
  std::iota(order.begin(), order.end(), Index{0});
  Part whole;
  whole.graph = graph;
  whole.positions.assign(positions.begin(), positions.end());
  whole.vertices = order;
  turn_in_order(whole.graph, whole.positions);
  Dissection(graph, order).run(std::move(whole));
  return order;
}

}  // namespace relievo::solver
