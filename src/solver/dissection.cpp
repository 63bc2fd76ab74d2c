#include "dissection.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "relievo/core/parallel.h"
#include "separator.h"
#include "solver/minimum_degree.h"

namespace relievo {
namespace {

// Below this, minimum degree finds a better order than another cut, and faster.
constexpr Index leaf_size = 120;

struct Part {
  Graph graph;
  std::vector<Eigen::Vector2f> positions;
  std::vector<Index> vertices;  // in the whole graph
  Index begin = 0;              // of this part's places in the order
};

// The vertices of one side with the edges among them.
Part extract(const Part& part, const Separation& cut, Side side) {
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

  // Level by level while parts are few, then part by part; what is done in parallel depends on sizes alone.
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
  // Writes the separator to its places; two empty parts if there is nothing left to cut.
  std::array<Part, 2> split(Part& part) {
    if (part.graph.size() <= leaf_size) {
      order_leaf(part);
      return {};
    }
    const Separation cut = separate(part.graph, part.positions);
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
    // Sets of bits grow with the square; what resists every cut and is this large is left as it is.
    if (places.size() <= 4096) LeafOrder(graph_, slots_).order(places);
  }

  const Graph& graph_;
  std::vector<Index>& order_;
  std::vector<Index> slots_;
};

// Grows with the angle, from 0 to 4.
float pseudo_angle(const Eigen::Vector2f& step) {
  const float sum = std::abs(step.x()) + std::abs(step.y());
  const float turn = sum > 0 ? step.x() / sum : 0;
  return step.y() >= 0 ? 1 - turn : 3 + turn;
}

// Neighbours counter-clockwise, as the search for paths wants them.
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

}  // namespace relievo
