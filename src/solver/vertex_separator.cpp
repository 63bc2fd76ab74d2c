#include "solver/dissection.h"

#include <algorithm>

#include "core/lists.h"

namespace relievo::solver {
namespace {

// Finds a maximum set of vertex-disjoint paths as a flow. Every vertex v is split into an entrance (state 2v)
// and an exit (state 2v + 1), which are connected by an arc of capacity 1. Arcs between vertices have unbounded
// capacity, so that only vertices can be cut. The path through a used vertex v comes from previous_[v] and continues to
// next_[v].
class PathFlow {
 public:
  explicit PathFlow(const SeparatorBand& band)
      : band_(band),
        graph_(band.graph),
        starts_(band.touches_first),
        ends_(band.touches_second),
        previous_(graph_.size(), no_index),
        next_(graph_.size(), no_index),
        is_used_(graph_.size(), 0),
        level_(2 * std::size_t{graph_.size()}),
        arc_(graph_.size()) {
    queue_.reserve(level_.size());
  }

  // Finds most paths greedily, before maximise(). Each path begins at the uppermost unused start and always takes the
  // leftmost turn. Vertices at which a walk turns back lie above the walk. In a planar graph a lower path would have
  // to cross the walk to reach them, so no vertex is visited twice.
  void take_uppermost_paths() {
    std::vector<std::uint8_t> is_seen(graph_.size(), 0);
    for (const Index start : starts_from_above())
      if (!is_seen[start] && find_uppermost_path(start, is_seen)) keep_path();
  }

  // Dinic's algorithm: augments the flow along shortest residual paths until no such path is left.
  void maximise() {
    while (find_levels()) {
      arc_ = graph_.begin;
      for (Index v = 0; v < graph_.size(); ++v)
        if (starts_[v] && level_[2 * v] == 0 && find_path(2 * v)) augment();
    }
  }

  // Returns the side of each vertex. Must be called after maximise(). A vertex is on the near side if its exit can be
  // reached in the residual network. If only its entrance can be reached, it belongs to the separator.
  std::vector<Side> cut(Side near, Side far) const {
    std::vector<Side> side(graph_.size(), far);
    for (Index v = 0; v < graph_.size(); ++v) {
      if (level_[2 * v + 1] != no_index)
        side[v] = near;
      else if (level_[2 * v] != no_index)
        side[v] = Side::separator;
    }
    return side;
  }

  // Reverses the flow, so that cut() starts from the other side.
  void reverse() {
    std::swap(starts_, ends_);
    std::swap(previous_, next_);
  }

 private:
  // A vertex of the current walk, its first neighbour to try, and how many neighbours were tried.
  struct Turn {
    Index vertex, first, tried;
  };

  std::vector<Index> starts_from_above() const {
    std::vector<Index> order = indices_where(graph_.size(), [&](Index v) { return starts_[v] != 0; });
    const Eigen::Vector2f up(-band_.direction.y(), band_.direction.x());
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
      const float ya = up.dot(band_.positions[a]), yb = up.dot(band_.positions[b]);
      return ya != yb ? ya > yb : a < b;
    });
    return order;
  }

  // Returns the position, in v's list, of the first neighbour to try at the start of a walk. This is the
  // leftmost turn: the next neighbour clockwise from the direction opposite to `band_.direction`.
  Index first_turn(Index v) const {
    const auto nearby = graph_.neighbours(v);
    Index best = 0;
    float best_angle = 5;
    for (Index i = 0; i < nearby.size(); ++i) {
      const Eigen::Vector2f step = band_.positions[nearby[i]] - band_.positions[v];
      const float x = -step.dot(band_.direction);
      const float y = step.x() * band_.direction.y() - step.y() * band_.direction.x();
      // `angle` increases clockwise from 0, in the backward direction (x = 1, y = 0), to 4. It replaces the angle in
      // comparisons, and needs no arc tangent.
      const float sum = std::abs(x) + std::abs(y), turn = sum > 0 ? x / sum : 1;
      const float angle = -y >= 0 ? 1 - turn : 3 + turn;
      if (angle < best_angle) best = i, best_angle = angle;
    }
    return best;
  }

  Index turn_after(Index v, Index from) const {
    const auto nearby = graph_.neighbours(v);
    const auto at = static_cast<Index>(std::find(nearby.begin(), nearby.end(), from) - nearby.begin());
    return (at + static_cast<Index>(nearby.size()) - 1) % static_cast<Index>(nearby.size());
  }

  bool find_uppermost_path(Index start, std::vector<std::uint8_t>& is_seen) {
    turns_.assign(1, {start, first_turn(start), 0});
    is_seen[start] = 1;
    while (!turns_.empty()) {
      Turn& turn = turns_.back();
      if (ends_[turn.vertex]) return true;
      const auto nearby = graph_.neighbours(turn.vertex);
      if (turn.tried == nearby.size()) {
        turns_.pop_back();
        continue;
      }
      const auto degree = static_cast<Index>(nearby.size());
      const Index v = turn.vertex, u = nearby[(turn.first + degree - turn.tried++) % degree];
      if (is_seen[u]) continue;
      is_seen[u] = 1;
      turns_.push_back({u, turn_after(u, v), 0});
    }
    return false;
  }

  void keep_path() {
    for (std::size_t i = 0; i < turns_.size(); ++i) {
      const Index v = turns_[i].vertex;
      is_used_[v] = 1;
      if (i > 0) previous_[v] = turns_[i - 1].vertex;
      if (i + 1 < turns_.size()) next_[v] = turns_[i + 1].vertex;
    }
  }

  void reach(Index state, Index level) {
    if (level_[state] != no_index) return;
    level_[state] = level;
    queue_.push_back(state);
  }

  // Writes the distances from the start in the residual network to level_. Returns whether the far end can be
  // reached. If so, the search stops there, and not all levels are known.
  bool find_levels() {
    std::fill(level_.begin(), level_.end(), no_index);
    queue_.clear();
    for (Index v = 0; v < graph_.size(); ++v)
      if (starts_[v]) reach(2 * v, 0);
    for (std::size_t head = 0; head < queue_.size(); ++head) {
      const Index state = queue_[head], v = state / 2, level = level_[state] + 1;
      if (state % 2 == 0) {
        const Index onwards = inner_arc(v);
        if (onwards != no_index) reach(onwards, level);
        continue;
      }
      if (ends_[v]) return true;
      if (is_used_[v]) reach(2 * v, level);
      for (const Index u : graph_.neighbours(v)) reach(2 * u, level);
    }
    return false;
  }

  // Returns the state after the entrance of v. If no path uses v, this is the exit of v. Otherwise it is the
  // exit of the previous vertex of the path through v, or no_index if this path begins at v.
  Index inner_arc(Index v) const {
    if (!is_used_[v]) return 2 * v + 1;
    return previous_[v] == no_index ? no_index : 2 * previous_[v] + 1;
  }

  // Searches depth first along increasing levels, and stores the states in path_. A dead end loses its level,
  // so each phase visits it only once.
  bool find_path(Index start) {
    path_.assign(1, start);
    while (!path_.empty()) {
      const Index state = path_.back();
      if (state % 2 == 1 && ends_[state / 2]) return true;
      const Index onwards = next_state(state);
      if (onwards != no_index) {
        path_.push_back(onwards);
      } else {
        level_[state] = no_index;
        path_.pop_back();
      }
    }
    return false;
  }

  Index next_state(Index state) {
    const Index v = state / 2, level = level_[state] + 1;
    if (state % 2 == 0) {
      const Index onwards = inner_arc(v);
      return onwards != no_index && level_[onwards] == level ? onwards : no_index;
    }
    for (; arc_[v] < graph_.begin[v + 1]; ++arc_[v])
      if (level_[2 * graph_.to[arc_[v]]] == level) return 2 * graph_.to[arc_[v]];
    return is_used_[v] && level_[2 * v] == level ? 2 * v : no_index;
  }

  void augment() {
    previous_[path_.front() / 2] = no_index;
    for (std::size_t i = 0; i + 1 < path_.size(); ++i) {
      const Index from = path_[i], to = path_[i + 1], v = from / 2, u = to / 2;
      if (v == u) {
        is_used_[v] = from % 2 == 0;
      } else if (from % 2 == 1) {
        next_[v] = u;
        previous_[u] = v;
      }
    }
    next_[path_.back() / 2] = no_index;
    // Paths are vertex-disjoint, so no other path of this phase may contain these states.
    for (const Index state : path_) level_[state] = no_index;
  }

  const SeparatorBand& band_;
  const Graph& graph_;
  std::vector<Turn> turns_;
  std::vector<std::uint8_t> starts_, ends_;
  std::vector<Index> previous_, next_;
  std::vector<std::uint8_t> is_used_;
  std::vector<Index> level_, arc_, queue_, path_;
};

}  // namespace

MinimumSeparators minimum_separators(const SeparatorBand& band) {
  PathFlow flow(band);
  flow.take_uppermost_paths();
  flow.maximise();
  MinimumSeparators cuts;
  cuts.near_first = flow.cut(Side::first, Side::second);
  flow.reverse();
  // The flow is already maximal. This call only finds the vertices that can be reached from the other side.
  flow.maximise();
  cuts.near_second = flow.cut(Side::second, Side::first);
  return cuts;
}

}  // namespace relievo::solver
