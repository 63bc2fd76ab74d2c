#include "solver/dissection.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/lists.h"
#include "relievo/core/parallel.h"

namespace relievo::solver {
namespace {

// Orders parts of a graph by minimum degree. One object should order many parts, because it reuses its
// memory.
class MinimumDegree {
 public:
  // Both arguments must outlive the object. `slots` has an element per vertex of the graph; all elements are
  // no_index before and after each call. Several objects may share `slots` and order parts concurrently, if
  // no edge connects these parts.
  MinimumDegree(const Graph& graph, std::span<Index> slots) : graph_(graph), slots_(slots) {}

  // Permutes the vertices of `piece` so that eliminating them in that order, before all others, causes little
  // fill. The next vertex is always one with the fewest remaining neighbours, including neighbours outside
  // the piece. The numbers of neighbours are exact and computed with bit sets. So time and memory grow at
  // least with the square of the piece's size, and the function is meant for up to a few hundred vertices.
  void order(std::span<Index> piece) {
    gather(piece);
    std::vector<Index> sequence;
    sequence.reserve(piece.size());
    for (std::size_t step = 0; step < piece.size(); ++step) {
      const auto least = std::min_element(degree_.begin(), degree_.end());
      const auto v = static_cast<Index>(least - degree_.begin());
      sequence.push_back(piece[v]);
      eliminate(v);
    }
    for (const Index v : piece) slots_[v] = no_index;
    std::copy(sequence.begin(), sequence.end(), piece.begin());
  }

 private:
  void gather(std::span<const Index> piece) {
    const auto n = static_cast<Index>(piece.size());
    for (Index i = 0; i < n; ++i) slots_[piece[i]] = i;
    outside_.clear();
    for (const Index v : piece)
      for (const Index u : graph_.neighbours(v))
        if (slots_[u] == no_index) outside_.push_back(u);
    std::sort(outside_.begin(), outside_.end());
    outside_.erase(std::unique(outside_.begin(), outside_.end()), outside_.end());

    words_ = (n + outside_.size() + 63) / 64;
    sets_.assign(n * words_, 0);
    degree_.resize(n);
    for (Index i = 0; i < n; ++i) {
      for (const Index u : graph_.neighbours(piece[i])) {
        const Index slot = slots_[u] != no_index ? slots_[u] : n + slot_outside(u);
        set(i)[slot / 64] |= std::uint64_t{1} << slot % 64;
      }
      degree_[i] = static_cast<Index>(graph_.neighbours(piece[i]).size());
    }
  }

  Index slot_outside(Index vertex) {
    return static_cast<Index>(std::lower_bound(outside_.begin(), outside_.end(), vertex) - outside_.begin());
  }

  // Connects all neighbours of v with each other, because eliminating v causes this fill. Neighbours outside the piece
  // come last and have no bit sets, so the loop ends at the first of them.
  void eliminate(Index v) {
    degree_[v] = no_index;
    const std::uint64_t* eliminated = set(v);
    for (std::size_t w = 0; w < words_; ++w) {
      for (std::uint64_t bits = eliminated[w]; bits != 0; bits &= bits - 1) {
        const auto u = static_cast<Index>(64 * w) + static_cast<Index>(std::countr_zero(bits));
        if (u >= degree_.size()) return;
        std::uint64_t* to = set(u);
        Index degree = 0;
        for (std::size_t i = 0; i < words_; ++i) {
          to[i] |= eliminated[i];
          if (i == v / 64) to[i] &= ~(std::uint64_t{1} << v % 64);
          if (i == u / 64) to[i] &= ~(std::uint64_t{1} << u % 64);
          degree += static_cast<Index>(std::popcount(to[i]));
        }
        degree_[u] = degree;
      }
    }
  }

  std::uint64_t* set(Index slot) { return sets_.data() + slot * words_; }

  const Graph& graph_;
  std::span<Index> slots_;
  std::vector<Index> outside_;  // vertices adjacent to the piece, ascending
  std::vector<std::uint64_t>
      sets_;  // per vertex of the piece: its neighbours, first within the piece, then in outside_
  std::vector<Index> degree_;  // number of remaining neighbours; no_index once eliminated
  std::size_t words_ = 0;
};

// For at most this many vertices, minimum degree is faster than another bisection and gives a better order.
constexpr Index leaf_size = 120;

struct Part {
  Graph graph;
  std::vector<Eigen::Vector2f> positions;
  std::vector<Index> vertices;  // indices of the vertices in the whole graph
  Index begin = 0;              // start of this part in the elimination order
};

// Returns the part of a graph that consists of the vertices on one side and the edges between them.
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

  // While parts are large, bisects level by level, so that the parts of a level are processed concurrently.
  // Then orders the many small parts concurrently. Only the size decides which parts are large, so the result
  // does not depend on the number of threads.
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
  // Writes the separator to the end of the part's range in the order. Returns the two sides. If the part is
  // small, orders it as a leaf and returns two empty parts.
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
    // The bit sets of MinimumDegree grow with the square of the size (2 MB at 4,096 vertices). A larger part that
    // cannot be bisected, such as a complete graph, keeps its given order.
    constexpr std::size_t largest_leaf = 4096;
    if (places.size() <= largest_leaf) MinimumDegree(graph_, slots_).order(places);
  }

  const Graph& graph_;
  std::vector<Index>& order_;
  std::vector<Index> slots_;
};

// Returns a number from 0 to 4 that increases with the angle of a vector. It replaces the angle in comparisons, and
// needs no arc tangent.
float pseudo_angle(const Eigen::Vector2f& step) {
  const float sum = std::abs(step.x()) + std::abs(step.y());
  const float turn = sum > 0 ? step.x() / sum : 0;
  return step.y() >= 0 ? 1 - turn : 3 + turn;
}

// Sorts each vertex's neighbours counter-clockwise, as minimum_separators() expects.
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
  std::vector<Index> order = all_indices(graph.size());
  Part whole;
  whole.graph = graph;
  whole.positions.assign(positions.begin(), positions.end());
  whole.vertices = order;
  turn_in_order(whole.graph, whole.positions);
  Dissection(graph, order).run(std::move(whole));
  return order;
}

}  // namespace relievo::solver
