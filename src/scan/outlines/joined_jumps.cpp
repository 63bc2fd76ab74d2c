#include "scan/outlines/outlines.h"

#include <algorithm>
#include <tuple>

namespace relievo {
namespace {

constexpr double widest_break = 4;  // widest gap that is closed, in rho
// The least cosine between any two of three directions: those at the two ends, and that of the gap between
// them.
constexpr double likeness = .5;
constexpr std::size_t end_points = 4;  // number of points that give the direction of an end

// A place where a jump begins or ends, and the jump's direction there.
struct End {
  Index curve;
  Vec2 place, direction;
};

// Finds for each open jump the jump that continues it, and joins chains of such jumps.
class JumpJoiner {
 public:
  JumpJoiner(std::vector<OutlineCurve>& outlines, double rho)
      : outlines_(outlines), rho_(rho), next_(outlines.size(), no_index), previous_(next_) {}

  void join() {
    for (const auto& [gap, from, to] : gaps())
      if (next_[from] == no_index && previous_[to] == no_index && last_of(to) != from)
        next_[from] = to, previous_[to] = from;
    for (Index c = 0; c < outlines_.size(); ++c)
      if (next_[c] != no_index && previous_[c] == no_index) outlines_[c] = joined(c);
    std::vector<OutlineCurve> kept;
    for (Index c = 0; c < outlines_.size(); ++c)
      if (previous_[c] == no_index) kept.push_back(std::move(outlines_[c]));
    outlines_ = std::move(kept);
  }

 private:
  // Returns the gaps that can be closed, the narrowest first: squared width, the jump before the gap, and the jump
  // after it.
  std::vector<std::tuple<double, Index, Index>> gaps() const {
    std::vector<End> ends, begins;
    std::vector<Vec2> places;
    for (Index c = 0; c < outlines_.size(); ++c) {
      const std::vector<Vec2>& p = outlines_[c].curve.points;
      if (!outlines_[c].is_jump || outlines_[c].is_closed || p.size() <= end_points) continue;
      ends.push_back({c, p.back(), (p.back() - p[p.size() - 1 - end_points]).normalized()});
      begins.push_back({c, p.front(), (p[end_points] - p.front()).normalized()});
      places.push_back(p.front());
    }
    const KdTree<Vec2> tree(places);
    std::vector<KdTree<Vec2>::Match> matches;
    std::vector<std::tuple<double, Index, Index>> found;
    for (const End& end : ends) {
      tree.within(end.place, widest_break * rho_, matches);
      for (const auto& [b, distance_sq] : matches)
        if (begins[b].curve != end.curve && continues(end, begins[b]))
          found.emplace_back(distance_sq, end.curve, begins[b].curve);
    }
    std::ranges::sort(found);
    return found;
  }

  static bool continues(const End& end, const End& begin) {
    const Vec2 gap = begin.place - end.place;
    const double most = likeness * gap.norm();
    return end.direction.dot(begin.direction) > likeness && gap.dot(end.direction) > most &&
           gap.dot(begin.direction) > most;
  }

  Index last_of(Index c) const {
    while (next_[c] != no_index) c = next_[c];
    return c;
  }

  // Returns the fair curve through all points of a jump and of the jumps linked after it.
  OutlineCurve joined(Index first) const {
    std::vector<CurveNode> nodes;
    bool is_crease = true;
    for (Index c = first; c != no_index; c = next_[c]) {
      is_crease &= outlines_[c].is_crease;
      for (const Vec2& place : outlines_[c].curve.points) nodes.push_back({place, 1});
    }
    return {fair_curve(nodes, false, jump_curve_options(rho_, is_crease)), false, true, is_crease};
  }

  std::vector<OutlineCurve>& outlines_;
  double rho_;
  std::vector<Index> next_, previous_;  // per outline: the next and the previous one; no_index for none
};

}  // namespace

void join_jumps(std::vector<OutlineCurve>& outlines, double rho) {
  JumpJoiner(outlines, rho).join();
}

}  // namespace relievo
