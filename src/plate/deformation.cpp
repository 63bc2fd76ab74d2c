#include "plate/deformation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/lists.h"
#include "plate/plate_ground.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Edges up to this length are not split. The length is smaller than any tool. It is several units in the last
// place of a single-precision coordinate of 10 m.
constexpr double shortest_mm = 4e-3;
constexpr int most_refinements = 60;  // each refinement halves edges, so plates need about 30 at most
constexpr std::size_t edges_per_task = 512;

// The positions at which a triangle will be split.
struct Split {
  // Per edge: the position of the split as a share of the edge, counted from the end with the lower index; 0
  // if the edge is not split.
  std::array<double, 3> shares = {};
  std::optional<Vec3> place;  // a new point inside the triangle, if no edge is split
  double left_mm = 0;         // if nothing is split: the largest sampled deviation
};

// A new point on the edge between two others.
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

// Refines in rounds. Each round samples the new triangles, adds all points that they need, and splits the
// triangles. Triangles are examined separately. But both triangles of an edge sample the edge at the same
// points, and therefore split it at the same point. So there are no T-junctions.
class Refiner {
 public:
  Refiner(Solid& flat, IndexPolygon& outline, const Deformation& deformation, double tolerance_mm)
      : flat_(flat), outline_(outline), deformation_(deformation), tolerance_(tolerance_mm) {
    deform_points();
    active_ = origin_ = all_indices(flat.triangles.size());
  }

  double run() {
    for (int round = 0; round < most_refinements && !active_.empty(); ++round) {
      const std::vector<Split> splits = find_splits();
      add_points(splits);
      extend_outline();
      deform_points();
      split_triangles(splits);
    }
    restore_order();
    return left_mm_;
  }

 private:
  void deform_points() {
    const std::size_t begin = deformed_.size();
    deformed_.resize(flat_.points.size());
    parallel_for(
        deformed_.size() - begin,
        [&](std::size_t i) { deformed_[begin + i] = deformation_.at(flat_.points[begin + i]); },
        edges_per_task);
  }

  std::vector<Split> find_splits() {
    std::vector<Split> splits(active_.size());
    parallel_for(
        splits.size(), [&](std::size_t i) { splits[i] = split_of(flat_.triangles[active_[i]]); },
        edges_per_task);
    for (const Split& split : splits) left_mm_ = std::max(left_mm_, split.left_mm);
    return splits;
  }

  Split split_of(const Triangle& t) const {
    Split split;
    bool is_split = false;
    for (std::size_t i = 0; i < 3; ++i) {
      split.shares[i] = share_of(edge_of(t, i), split.left_mm);
      is_split |= split.shares[i] > 0;
    }
    if (is_split)
      split.left_mm = 0;
    else
      split.place = place_within(t, split.left_mm);
    return split;
  }

  // Returns where to split an edge, as a share of its length; 0 if the edge is within the tolerance. The
  // result is the same for both triangles of the edge. If the edge crosses a crease, only the crossing is
  // measured, because the deviation is largest there, and splits at midpoints would approach the crease
  // slowly. Other edges have two samples per feature, so that a wave that is 0 at the midpoint is noticed.
  double share_of(const std::array<Index, 2>& ends, double& left_mm) const {
    const auto& [a, b] = ends;
    const Vec3 &p = flat_.points[a], &q = flat_.points[b];
    const double length = (q - p).norm();
    const auto off_at = [&](double share) {
      return (deformation_.at(p + share * (q - p)) - deformed_[a] - share * (deformed_[b] - deformed_[a]))
          .norm();
    };
    const auto crease = deformation_.crease_between ? deformation_.crease_between(p, q) : std::nullopt;
    const double count = crease ? 1 : 1 + 2 * std::floor(std::min(length / deformation_.min_feature_mm, 1e5));
    double off = 0;
    for (double i = 1; i <= count && off <= share_of_edges * tolerance_; ++i)
      off = std::max(off, off_at(crease ? *crease : i / (count + 1)));
    const bool is_split = off > share_of_edges * tolerance_ && length > shortest_mm;
    if (!is_split) left_mm = std::max(left_mm, off);
    return !is_split ? 0 : crease ? *crease : .5;
  }

  // Samples the deviation inside the triangle. Returns the position of the first sample that exceeds the
  // tolerance. Samples lie on lines parallel to the longest edge. They are needed only if all three edges are
  // within the tolerance, for example on top of a hill.
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
    const double rows = 1 + std::floor(height / deformation_.min_feature_mm);
    for (double row = 1; row <= rows; ++row) {
      const double to_c = row / (rows + 2);
      const double columns = 1 + std::floor((1 - to_c) * length(longest) / deformation_.min_feature_mm);
      for (double column = .5; column < columns; ++column) {
        const double to_b = (1 - to_c) * column / columns, to_a = 1 - to_b - to_c;
        const Vec3 place = to_a * p + to_b * q + to_c * r;
        const double off =
            (deformation_.at(place) - to_a * deformed_[a] - to_b * deformed_[b] - to_c * deformed_[c]).norm();
        if (off > tolerance_) return Vec3(place);
        left_mm = std::max(left_mm, off);
      }
    }
    return std::nullopt;
  }

  void add_points(const std::vector<Split>& splits) {
    between_.clear();
    for (std::size_t i = 0; i < splits.size(); ++i)
      for (std::size_t e = 0; e < 3; ++e)
        if (splits[i].shares[e] > 0)
          between_.push_back({edge_of(flat_.triangles[active_[i]], e), splits[i].shares[e]});
    std::ranges::sort(between_, is_before);
    const auto repeated =
        std::ranges::unique(between_, [](const Between& a, const Between& b) { return a.ends == b.ends; });
    between_.erase(repeated.begin(), repeated.end());
    first_between_ = static_cast<Index>(flat_.points.size());
    for (const auto& [ends, share] : between_) add_point(ends[0], ends[1], share);
    first_within_ = static_cast<Index>(flat_.points.size());
    for (std::size_t i = 0; i < splits.size(); ++i) {
      if (!splits[i].place) continue;
      const Triangle t = flat_.triangles[active_[i]];
      add_point(t[0], t[1], .5);
      flat_.points.back() = *splits[i].place;
    }
  }

  void add_point(Index a, Index b, double share) {
    const Vec3 p = flat_.points[a] + share * (flat_.points[b] - flat_.points[a]);
    flat_.points.push_back(p);
    if (flat_.colours.empty()) return;
    const Colour colour = mixed(flat_.colours[a], flat_.colours[b], share);
    flat_.colours.push_back(colour);
  }

  // Returns the new point on the edge between two points; no_index if the edge is not split.
  Index between(const std::array<Index, 2>& ends) const {
    const auto found = std::ranges::lower_bound(between_, Between{ends, 0}, is_before);
    if (found == between_.end() || found->ends != ends) return no_index;
    return first_between_ + static_cast<Index>(found - between_.begin());
  }

  void split_triangles(const std::vector<Split>& splits) {
    Index within = first_within_;
    const std::vector<Index> active = std::exchange(active_, {});
    for (std::size_t i = 0; i < splits.size(); ++i) {
      const Triangle t = flat_.triangles[active[i]];
      std::array<Index, 3> middle = {no_index, no_index, no_index};
      for (std::size_t e = 0; e < 3; ++e)
        if (splits[i].shares[e] > 0) middle[e] = between(edge_of(t, e));
      parts_.clear();
      if (splits[i].place)
        split_at(t, within++);
      else
        split(t, middle);
      if (parts_.empty()) continue;
      replace(active[i]);
    }
  }

  void split_at(const Triangle& t, Index within) {
    for (std::size_t e = 0; e < 3; ++e) parts_.push_back({t[e], t[(e + 1) % 3], within});
  }

  // Splits a triangle into two to four triangles. `middle` contains the new point on each edge, or no_index. A
  // quadrilateral is divided by its shorter diagonal, because the longer diagonal would give thinner triangles.
  void split(const Triangle& t, const std::array<Index, 3>& middle) {
    const auto count = std::ranges::count_if(middle, [](Index i) { return i != no_index; });
    if (count == 0) return;
    if (count == 3) {
      for (std::size_t e = 0; e < 3; ++e) parts_.push_back({t[e], middle[e], middle[(e + 2) % 3]});
      parts_.push_back({middle[0], middle[1], middle[2]});
      return;
    }
    // If one edge is split, it gets number e. If two are split, they get the numbers e and e + 1.
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

  // Replaces triangle t by its parts: the first part gets index t, the others are appended to the triangles.
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
    IndexPolygon longer;
    for (std::size_t i = 0; i < outline_.size(); ++i) {
      const Index a = outline_[i], b = outline_[(i + 1) % outline_.size()];
      longer.push_back(a);
      const Index m = between({std::min(a, b), std::max(a, b)});
      if (m == no_index) continue;
      longer.push_back(m);
      const double share = between_[m - first_between_].share;
      flat_.points[m].head<2>() += convexity_offset((flat_.points[b] - flat_.points[a]).head<2>(), share);
    }
    outline_ = std::move(longer);
  }

  // Sorts the triangles by the index of their original triangle, so that the front's triangles come first again.
  void restore_order() {
    std::vector<Index> order = all_indices(origin_.size());
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
  IndexPolygon& outline_;
  const Deformation& deformation_;
  double tolerance_, left_mm_ = 0;
  std::vector<Vec3> deformed_;    // deformed points
  std::vector<Index> origin_;     // per triangle: the index of its original triangle
  std::vector<Index> active_;     // the triangles that are new in this round
  std::vector<Between> between_;  // this round's new points on edges, sorted by the edges' ends
  Index first_between_ = 0, first_within_ = 0;
  std::vector<Triangle> parts_;
};

}  // namespace

double refine(Solid& flat, IndexPolygon& outline, const Deformation& deformation, double tolerance_mm) {
  return Refiner(flat, outline, deformation, tolerance_mm).run();
}

}  // namespace relievo
