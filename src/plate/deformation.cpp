#include "bend.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

constexpr double shortest_mm = 4e-3;
constexpr int most_rounds = 60;
constexpr std::size_t grain = 512;

// Where a triangle is to be cut.
struct Cut {
  std::array<double, 3> shares =
      {};                     // of the way from the lower to the higher index of each edge; 0 for none
  std::optional<Vec3> place;  // within, where no edge is cut
  double left_mm = 0;         // largest distance seen where nothing is cut
};

// A point between two others.
struct Between {
  std::array<Index, 2> ends;
  double share;
};

bool is_before(const Between& a, const Between& b) {
  return a.ends < b.ends;
}

std::array<Index, 2> edge_of(const Triangle& t, std::size_t i) {
  const Index a = t[i], b = t[(i + 1) % 3];
  return {std::min(a, b), std::max(a, b)};
}

Colour mixed(const Colour& a, const Colour& b, double share) {
  Colour out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = static_cast<std::uint8_t>(a[i] + share * (b[i] - a[i]) + .5);
  return out;
}

class Refiner {
 public:
  Refiner(Solid& flat, Loop& outline, const Bend& bend, double tolerance_mm)
      : flat_(flat), outline_(outline), bend_(bend), tolerance_(tolerance_mm) {
    bend_points();
    origin_.resize(flat.triangles.size());
    for (Index t = 0; t < origin_.size(); ++t) origin_[t] = t;
    active_ = origin_;
  }

  double run() {
    for (int round = 0; round < most_rounds && !active_.empty(); ++round) {
      const std::vector<Cut> cuts = find_cuts();
      add_points(cuts);
      extend_outline();
      bend_points();
      cut_triangles(cuts);
    }
    restore_order();
    return left_mm_;
  }

 private:
  void bend_points() {
    const std::size_t begin = bent_.size();
    bent_.resize(flat_.points.size());
    parallel_for(
        bent_.size() - begin, [&](std::size_t i) { bent_[begin + i] = bend_.at(flat_.points[begin + i]); },
        grain);
  }

  std::vector<Cut> find_cuts() {
    std::vector<Cut> cuts(active_.size());
    parallel_for(
        cuts.size(), [&](std::size_t i) { cuts[i] = cut_of(flat_.triangles[active_[i]]); }, grain);
    for (const Cut& cut : cuts) left_mm_ = std::max(left_mm_, cut.left_mm);
    return cuts;
  }

  Cut cut_of(const Triangle& t) const {
    Cut cut;
    bool is_cut = false;
    for (std::size_t i = 0; i < 3; ++i) {
      cut.shares[i] = share_of(edge_of(t, i), cut.left_mm);
      is_cut |= cut.shares[i] > 0;
    }
    if (is_cut)
      cut.left_mm = 0;
    else
      cut.place = place_within(t, cut.left_mm);
    return cut;
  }

  // Where to cut an edge, the same for both its triangles; 0 if it is near enough. Its share of the tolerance
  // leaves that of a triangle's inside, which is off by up to 4/3 of its edges' where the surface bends
  // evenly.
  double share_of(const std::array<Index, 2>& ends, double& left_mm) const {
    const auto& [a, b] = ends;
    const Vec3 &p = flat_.points[a], &q = flat_.points[b];
    const double length = (q - p).norm();
    const auto off_at = [&](double share) {
      return (bend_.at(p + share * (q - p)) - bent_[a] - share * (bent_[b] - bent_[a])).norm();
    };
    const auto corner = bend_.corner_between ? bend_.corner_between(p, q) : std::nullopt;
    const double count = corner ? 1 : 1 + 2 * std::floor(std::min(length / bend_.feature_mm, 1e5));
    double off = 0;
    for (double i = 1; i <= count && off <= .75 * tolerance_; ++i)
      off = std::max(off, off_at(corner ? *corner : i / (count + 1)));
    const bool is_cut = off > .75 * tolerance_ && length > shortest_mm;
    if (!is_cut) left_mm = std::max(left_mm, off);
    return !is_cut ? 0 : corner ? *corner : .5;
  }

  // The first place inside that is off too much: along rows from the longest edge to the corner that faces
  // it.
  std::optional<Vec3> place_within(const Triangle& t, double& left_mm) const {
    const auto length = [&](std::size_t i) {
      return (flat_.points[t[(i + 1) % 3]] - flat_.points[t[i]]).norm();
    };
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (length(i) > length(longest)) longest = i;
    if (length(longest) <= shortest_mm) return std::nullopt;
    const Index a = t[longest], b = t[(longest + 1) % 3], c = t[(longest + 2) % 3];
    const Vec3 &p = flat_.points[a], &q = flat_.points[b], &r = flat_.points[c];
    const double height = (q - p).cross(r - p).norm() / length(longest);
    const double rows = 1 + std::floor(height / bend_.feature_mm);
    for (double row = 1; row <= rows; ++row) {
      const double to_c = row / (rows + 2);
      const double columns = 1 + std::floor((1 - to_c) * length(longest) / bend_.feature_mm);
      for (double column = .5; column < columns; ++column) {
        const double to_b = (1 - to_c) * column / columns, to_a = 1 - to_b - to_c;
        const Vec3 place = to_a * p + to_b * q + to_c * r;
        const double off = (bend_.at(place) - to_a * bent_[a] - to_b * bent_[b] - to_c * bent_[c]).norm();
        if (off > tolerance_) return Vec3(place);
        left_mm = std::max(left_mm, off);
      }
    }
    return std::nullopt;
  }

  void add_points(const std::vector<Cut>& cuts) {
    between_.clear();
    for (std::size_t i = 0; i < cuts.size(); ++i)
      for (std::size_t e = 0; e < 3; ++e)
        if (cuts[i].shares[e] > 0)
          between_.push_back({edge_of(flat_.triangles[active_[i]], e), cuts[i].shares[e]});
    std::ranges::sort(between_, is_before);
    const auto repeated =
        std::ranges::unique(between_, [](const Between& a, const Between& b) { return a.ends == b.ends; });
    between_.erase(repeated.begin(), repeated.end());
    first_between_ = static_cast<Index>(flat_.points.size());
    for (const auto& [ends, share] : between_) add_point(ends[0], ends[1], share);
    first_within_ = static_cast<Index>(flat_.points.size());
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      if (!cuts[i].place) continue;
      const Triangle t = flat_.triangles[active_[i]];
      add_point(t[0], t[1], .5);
      flat_.points.back() = *cuts[i].place;
    }
  }

  void add_point(Index a, Index b, double share) {
    const Vec3 p = flat_.points[a] + share * (flat_.points[b] - flat_.points[a]);
    flat_.points.push_back(p);
    if (flat_.colours.empty()) return;
    const Colour colour = mixed(flat_.colours[a], flat_.colours[b], share);
    flat_.colours.push_back(colour);
  }

  // The point between two; no_index if there is none.
  Index between(const std::array<Index, 2>& ends) const {
    const auto found = std::ranges::lower_bound(between_, Between{ends, 0}, is_before);
    if (found == between_.end() || found->ends != ends) return no_index;
    return first_between_ + static_cast<Index>(found - between_.begin());
  }

  void cut_triangles(const std::vector<Cut>& cuts) {
    Index within = first_within_;
    const std::vector<Index> active = std::exchange(active_, {});
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      const Triangle t = flat_.triangles[active[i]];
      std::array<Index, 3> middle = {no_index, no_index, no_index};
      for (std::size_t e = 0; e < 3; ++e)
        if (cuts[i].shares[e] > 0) middle[e] = between(edge_of(t, e));
      parts_.clear();
      if (cuts[i].place)
        fan(t, within++);
      else
        cut(t, middle);
      if (parts_.empty()) continue;
      replace(active[i]);
    }
  }

  void fan(const Triangle& t, Index within) {
    for (std::size_t e = 0; e < 3; ++e) parts_.push_back({t[e], t[(e + 1) % 3], within});
  }

  // `middle` are the points on the edges.
  void cut(const Triangle& t, const std::array<Index, 3>& middle) {
    const auto count = std::ranges::count_if(middle, [](Index i) { return i != no_index; });
    if (count == 0) return;
    if (count == 3) {
      for (std::size_t e = 0; e < 3; ++e) parts_.push_back({t[e], middle[e], middle[(e + 2) % 3]});
      parts_.push_back({middle[0], middle[1], middle[2]});
      return;
    }
    // Begins with an edge that is cut; of two with the one before the other.
    std::size_t e = 0;
    while (middle[e] == no_index || (count == 2 && middle[(e + 1) % 3] == no_index)) ++e;
    const Index a = t[e], b = t[(e + 1) % 3], c = t[(e + 2) % 3], m = middle[e], n = middle[(e + 1) % 3];
    if (count == 1) {
      parts_.insert(parts_.end(), {{a, m, c}, {m, b, c}});
      return;
    }
    parts_.push_back({m, b, n});
    const bool is_shorter =
        (flat_.points[a] - flat_.points[n]).norm() <= (flat_.points[m] - flat_.points[c]).norm();
    if (is_shorter)
      parts_.insert(parts_.end(), {{a, m, n}, {a, n, c}});
    else
      parts_.insert(parts_.end(), {{a, m, c}, {m, n, c}});
  }

  // Puts the parts in the place of triangle t.
  void replace(Index t) {
    flat_.triangles[t] = parts_[0];
    active_.push_back(t);
    for (std::size_t i = 1; i < parts_.size(); ++i) {
      active_.push_back(static_cast<Index>(flat_.triangles.size()));
      flat_.triangles.push_back(parts_[i]);
      origin_.push_back(origin_[t]);
    }
  }

  void extend_outline() {
    Loop longer;
    for (std::size_t i = 0; i < outline_.size(); ++i) {
      const Index a = outline_[i], b = outline_[(i + 1) % outline_.size()];
      longer.push_back(a);
      const Index m = between({std::min(a, b), std::max(a, b)});
      if (m == no_index) continue;
      longer.push_back(m);
      const double share = between_[m - first_between_].share;
      flat_.points[m].head<2>() += bulge((flat_.points[b] - flat_.points[a]).head<2>(), share);
    }
    outline_ = std::move(longer);
  }

  // Sorts the triangles by those that they come from.
  void restore_order() {
    std::vector<Index> order(origin_.size());
    for (Index t = 0; t < order.size(); ++t) order[t] = t;
    std::ranges::stable_sort(order, {}, [&](Index t) { return origin_[t]; });
    const auto front = static_cast<std::size_t>(
        std::ranges::count_if(origin_, [&](Index t) { return t < flat_.front_triangles; }));
    std::vector<Triangle> triangles;
    std::vector<Region> regions;
    for (const Index t : order) {
      triangles.push_back(flat_.triangles[t]);
      if (origin_[t] < flat_.regions.size()) regions.push_back(flat_.regions[origin_[t]]);
    }
    flat_.triangles = std::move(triangles);
    flat_.regions = std::move(regions);
    flat_.front_triangles = front;
  }

  Solid& flat_;
  Loop& outline_;
  const Bend& bend_;
  double tolerance_, left_mm_ = 0;
  std::vector<Vec3> bent_;        // the points, bent
  std::vector<Index> origin_;     // of each triangle: the one that it was cut from
  std::vector<Index> active_;     // triangles that are new
  std::vector<Between> between_;  // points of this round, sorted by their ends
  Index first_between_ = 0, first_within_ = 0;
  std::vector<Triangle> parts_;
};

}  // namespace

double refine(Solid& flat, Loop& outline, const Bend& bend, double tolerance_mm) {
  return Refiner(flat, outline, bend, tolerance_mm).run();
}

}  // namespace relievo
