#include "geometry/outline_union.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "geometry/plane.h"

namespace relievo {
namespace {

constexpr double grain = 1e-6;            // coordinates of corners are rounded to multiples of this
constexpr double touching = 1.5 * grain;  // a corner this close to a side lies on it
// Distance from a side's midpoint at which the winding numbers on both sides are computed.
constexpr double beside = 4 * grain;
constexpr int most_rounds = 6;

Vec2 rounded(const Vec2& p) {
  return (p / grain).array().round() * grain;
}

// A side, and the points where other sides meet it.
struct CutSide {
  Vec2 from, to;
  std::vector<Vec2> cuts = {};
};

// If the point lies on the side and is not one of its ends, cuts the side there. Returns whether the side was cut.
bool cut_at_corner(CutSide& side, const Vec2& point) {
  if (point == side.from || point == side.to) return false;
  const Vec2 step = side.to - side.from, offset = point - side.from;
  const double share = offset.dot(step) / step.squaredNorm();
  if (!(share > 0 && share < 1) || (offset - share * step).norm() > touching) return false;
  side.cuts.push_back(point);
  return true;
}

bool cut_where_crossing(CutSide& a, CutSide& b) {
  const Vec2 u = a.to - a.from, v = b.to - b.from, offset = b.from - a.from;
  const double area = cross(u, v);
  if (area == 0) return false;
  const double s = cross(offset, v) / area, t = cross(offset, u) / area;
  if (!(s > 0 && s < 1 && t > 0 && t < 1)) return false;
  const Vec2 place = rounded(a.from + s * u);
  const auto cut = [&](CutSide& side) {
    if (place == side.from || place == side.to) return false;
    side.cuts.push_back(place);
    return true;
  };
  const bool is_first = cut(a), is_second = cut(b);
  return is_first || is_second;
}

bool cut_each_other(CutSide& a, CutSide& b) {
  bool is_cut = false;
  for (const Vec2& p : {b.from, b.to}) is_cut |= cut_at_corner(a, p);
  for (const Vec2& p : {a.from, a.to}) is_cut |= cut_at_corner(b, p);
  return is_cut || cut_where_crossing(a, b);
}

// Finds the points where sides meet, by a sweep along x. Returns false if no sides meet.
bool find_cuts(std::vector<CutSide>& sides) {
  std::ranges::stable_sort(sides, {}, [](const CutSide& s) { return std::min(s.from.x(), s.to.x()); });
  bool is_cut = false;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const double right = std::max(sides[i].from.x(), sides[i].to.x()) + touching,
                 low = std::min(sides[i].from.y(), sides[i].to.y()) - touching,
                 high = std::max(sides[i].from.y(), sides[i].to.y()) + touching;
    for (std::size_t j = i + 1; j < sides.size(); ++j) {
      const CutSide& other = sides[j];
      if (std::min(other.from.x(), other.to.x()) > right) break;
      if (std::max(other.from.y(), other.to.y()) < low || std::min(other.from.y(), other.to.y()) > high)
        continue;
      is_cut |= cut_each_other(sides[i], sides[j]);
    }
  }
  return is_cut;
}

std::vector<CutSide> pieces_of(std::vector<CutSide> sides) {
  std::vector<CutSide> pieces;
  for (CutSide& side : sides) {
    const Vec2 step = side.to - side.from;
    std::ranges::stable_sort(side.cuts, {}, [&](const Vec2& p) { return (p - side.from).dot(step); });
    side.cuts.push_back(side.to);
    Vec2 from = side.from;
    for (const Vec2& to : side.cuts) {
      if (from != to) pieces.push_back({from, to});
      from = to;
    }
  }
  return pieces;
}

std::vector<CutSide> sides_of(const Outlines& outlines) {
  std::vector<CutSide> sides;
  for (const std::vector<Vec2>& outline : outlines)
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2 from = rounded(outline[i]), to = rounded(outline[(i + 1) % outline.size()]);
      if (from != to) sides.push_back({from, to});
    }
  return sides;
}

// Returns 1 if the side from a to b crosses the horizontal ray to the right of `place` upwards, -1 if it
// crosses this ray downwards, else 0. The sum over all sides is the winding number.
int turns_at(const Vec2& a, const Vec2& b, const Vec2& place) {
  const double left = cross(b - a, place - a);
  if (a.y() <= place.y() && b.y() > place.y() && left > 0) return 1;
  return b.y() <= place.y() && a.y() > place.y() && left < 0 ? -1 : 0;
}

// Computes winding numbers. Sides are sorted into horizontal strips, so that a position is compared only with
// the sides in its strip.
class WindingRows {
 public:
  explicit WindingRows(const std::vector<CutSide>& sides) : sides_(sides) {
    std::vector<double> ys;
    for (const CutSide& s : sides) ys.push_back(s.from.y());
    low_ = ys.empty() ? 0 : *std::ranges::min_element(ys);
    const double high = ys.empty() ? 1 : *std::ranges::max_element(ys);
    rows_.resize(std::clamp<std::size_t>(sides.size() / 4, 1, 4096));
    step_ = std::max(high - low_, grain) / static_cast<double>(rows_.size());
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const std::size_t first = row_of(std::min(sides[i].from.y(), sides[i].to.y())),
                        last = row_of(std::max(sides[i].from.y(), sides[i].to.y()));
      for (std::size_t r = first; r <= last; ++r) rows_[r].push_back(i);
    }
  }

  int at(const Vec2& place) const {
    int turns = 0;
    for (const std::size_t i : rows_[row_of(place.y())])
      turns += turns_at(sides_[i].from, sides_[i].to, place);
    return turns;
  }

 private:
  std::size_t row_of(double y) const {
    return static_cast<std::size_t>(
        std::clamp((y - low_) / step_, 0.0, static_cast<double>(rows_.size() - 1)));
  }

  const std::vector<CutSide>& sides_;
  double low_ = 0, step_ = 1;
  std::vector<std::vector<std::size_t>> rows_;
};

}  // namespace

int winding_number(const Outlines& outlines, const Vec2& place) {
  int turns = 0;
  for (const std::vector<Vec2>& outline : outlines)
    for (std::size_t i = 0; i < outline.size(); ++i)
      turns += turns_at(outline[i], outline[(i + 1) % outline.size()], place);
  return turns;
}

std::vector<Segment> union_boundary(const Outlines& outlines) {
  std::vector<CutSide> sides = sides_of(outlines);
  for (int round = 0; round < most_rounds && find_cuts(sides); ++round) sides = pieces_of(std::move(sides));
  const WindingRows winding(sides);
  std::set<std::tuple<double, double, double, double>> known;
  std::vector<Segment> boundary;
  for (const CutSide& side : sides) {
    const Vec2 step = side.to - side.from, middle = (side.from + side.to) / 2,
               aside = beside * Vec2(-step.y(), step.x()) / step.norm();
    const bool is_left = winding.at(middle + aside) != 0, is_right = winding.at(middle - aside) != 0;
    if (is_left == is_right) continue;
    const Segment kept =
        is_left ? Segment{.from = side.from, .to = side.to} : Segment{.from = side.to, .to = side.from};
    if (known.insert({kept.from.x(), kept.from.y(), kept.to.x(), kept.to.y()}).second)
      boundary.push_back(kept);
  }
  return boundary;
}

}  // namespace relievo
