#include "scan/outlines/row_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/near_search.h"
#include "relievo/core/parallel.h"
#include "scan/jumps.h"
#include "scan/linear_field.h"

namespace relievo {
namespace {

// Distances of the rows from an outline, in rho, the sampling distance. Only jumps have a row at the first distance.
constexpr std::array row_distance = {half_wall, .45, 1.0, 1.6, 2.25, last_row};
// Least distances between points of rows, in rho. They are smaller on outlines and in the row next to an
// outline.
constexpr double least_between_rows = .4, least_in_first_row = .28, least_on_outlines = .12;
// The least distance of a wall from another outline, in rho. Walls end before they reach another outline.
constexpr double least_from_other_outline = .35;

// Makes the points of all rows, from the rows nearest to the outlines outwards.
class RowMaker {
 public:
  RowMaker(const std::vector<OutlineCurve>& outlines, const SegmentGrid& grid, double rho, PointSet& taken)
      : outlines_(outlines), grid_(grid), rho_(rho), taken_(taken) {}

  std::vector<RowPoint> make() {
    for (Index c = 0; c < outlines_.size(); ++c)
      if (!outlines_[c].is_jump) add_silhouette(c);
    for (Index c = 0; c < outlines_.size(); ++c)
      if (outlines_[c].is_jump) add_row(c, 0, 1), add_row(c, 0, -1);
    for (std::size_t row = 1; row < row_distance.size(); ++row)
      for (Index c = 0; c < outlines_.size(); ++c) {
        add_row(c, row, 1);
        if (outlines_[c].is_jump) add_row(c, row, -1);
      }
    return std::move(points_);
  }

 private:
  // Returns a vector to the left of an outline at one of its points. Its length is 1 where the outline is
  // straight. At a turn it is longer, so that the lines through its end, parallel to the edges before and
  // after the point, are at distance 1 from these edges.
  Vec2 left_at(const OutlineCurve& outline, std::size_t k) const {
    const std::vector<Vec2>& p = outline.curve.points;
    const std::size_t n = p.size();
    const Vec2 after = k + 1 < n || outline.is_closed ? Vec2(p[(k + 1) % n] - p[k]) : Vec2(p[k] - p[k - 1]);
    const Vec2 before = k > 0 || outline.is_closed ? Vec2(p[k] - p[(k + n - 1) % n]) : after;
    const Vec2 sum = after.normalized() + before.normalized();
    if (!(sum.norm() > 1e-6)) return {-after.normalized().y(), after.normalized().x()};
    const Vec2 along = sum.normalized();
    const double cosine = std::max(.3, along.dot(after.normalized()));
    return Vec2(-along.y(), along.x()) / cosine;
  }

  void add_silhouette(Index c) {
    const OutlineCurve& outline = outlines_[c];
    ++row_;
    for (std::size_t k = 0; k < outline.curve.points.size(); ++k) {
      row_ += outline.curve.is_corner[k];
      const Vec2 at = outline.curve.points[k];
      if (taken_.add(at, least_on_outlines * rho_))
        points_.push_back({at, at + .05 * rho_ * left_at(outline, k), Place::silhouette, row_});
    }
  }

  // Adds a row on the left (side 1) or on the right (side -1) of an outline. Odd rows have their points
  // beside the midpoints of the curve's edges, even rows beside the curve's points. Row 0, at a wall, has
  // points beside all of these, so that the long sides of the wall are edges of the Delaunay triangulation.
  void add_row(Index c, std::size_t row, double side) {
    const OutlineCurve& outline = outlines_[c];
    const std::size_t n = outline.curve.points.size();
    const Place place = row > 0 ? Place::row : side > 0 ? Place::front : Place::back;
    // The number of positions beside which a row may have points: the points of the curve and the midpoints of its
    // edges.
    const std::size_t halves = outline.is_closed ? 2 * n : 2 * n - 1;
    const std::size_t first = row % 2, stride = row == 0 ? 1 : 2;
    std::vector<Candidate> candidates((halves - first + stride - 1) / stride);
    parallel_for(
        candidates.size(),
        [&](std::size_t i) { candidates[i] = candidate(c, first + i * stride, row, side); }, 64);
    const double apart = row == 0 ? least_on_outlines : row == 1 ? least_in_first_row : least_between_rows;
    ++row_;
    for (const auto& [at, is_free, is_corner] : candidates) {
      row_ += is_corner;
      if (is_free && taken_.add(at, apart * rho_)) points_.push_back({at, at, place, row_});
    }
  }

  // A possible position for a point of a row.
  struct Candidate {
    Vec2 at;
    bool is_free;
    bool is_corner;  // whether it is beside a corner of the outline
  };

  // Returns the position in a row beside position `half` of the curve. Even numbers are the curve's points, odd
  // numbers the midpoints of its edges.
  Candidate candidate(Index c, std::size_t half, std::size_t row, double side) const {
    const OutlineCurve& outline = outlines_[c];
    const std::vector<Vec2>& p = outline.curve.points;
    const std::size_t k = half / 2, next = (k + 1) % p.size();
    const bool is_between = half % 2 == 1;
    const Vec2 left = is_between ? (left_at(outline, k) + left_at(outline, next)) / 2 : left_at(outline, k);
    const Vec2 from = is_between ? Vec2((p[k] + p[next]) / 2) : p[k];
    const Vec2 at = from + row_distance[row] * rho_ * side * left;
    return {at, is_free(c, from + .02 * rho_ * side * left, at, row),
            !is_between && outline.curve.is_corner[k] != 0};
  }

  // Returns whether a row may have a point at `at`: no outline separates it from the row's own outline, and no
  // outline is too close.
  bool is_free(Index c, const Vec2& from, const Vec2& at, std::size_t row) const {
    const double distance = row_distance[row] * rho_, nearest = .9 * distance;
    if (grid_.is_crossed(from, at) || grid_.nearest(at, nearest).segment != no_index) return false;
    return row > 0 || grid_.nearest(at, least_from_other_outline * rho_, c).segment == no_index;
  }

  const std::vector<OutlineCurve>& outlines_;
  const SegmentGrid& grid_;
  double rho_;
  PointSet& taken_;
  std::vector<RowPoint> points_;
  Index row_ = 0;  // number of the row whose points are added
};

constexpr double fit_radius = 2.5;     // in rho; up to 2.56 times as large if there are few points
constexpr float least_likeness = .8F;  // least cosine (37 degrees) between normals of the same face
constexpr int least_face_points = 5;

}  // namespace

std::vector<RowPoint> row_points(const std::vector<OutlineCurve>& outlines, const SegmentGrid& grid,
                                 double rho, PointSet& taken) {
  return RowMaker(outlines, grid, rho, taken).make();
}

std::vector<SideInterpolation::Value> SideInterpolation::at(std::span<const RowPoint> rows) const {
  std::vector<Value> values(rows.size());
  const auto ball = [&](std::size_t r) -> NearSearch<Vec2>::Ball {
    return {rows[r].at, fit_radius * in_.surface.rho};
  };
  parallel_ranges(rows.size(), 256, [&](std::size_t begin, std::size_t end) {
    NearSearch<Vec2> search(in_.plane.tree, in_.plane.places);
    Around around;
    search.each(begin, end, ball, [&](std::size_t r, std::span<const Index> near) {
      around.matches.clear();
      for (const Index i : near)
        around.matches.emplace_back(i, (in_.plane.places[i] - rows[r].at).squaredNorm());
      values[r] = at(rows[r], around);
    });
  });
  return values;
}

// Returns the values at a new point. around.matches has the points within the radius of a fit. If too few of them can
// be used, points farther away are added.
SideInterpolation::Value SideInterpolation::at(const RowPoint& p, Around& around) const {
  double radius = fit_radius * in_.surface.rho;
  std::vector<Match>& matches = around.matches;
  leave_same_side(p, radius, around);
  for (int attempt = 1; attempt < 3 && matches.size() < 6; ++attempt) {
    in_.plane.tree.within(p.at, radius *= 1.6, matches);
    leave_same_side(p, radius, around);
  }
  // In a sliver between two outlines all points may be on these outlines. Then a new point of the silhouette is
  // interpolated from them. If it were left out, long triangles would cross the sliver.
  if (matches.empty() && p.place == Place::silhouette)
    in_.plane.tree.within(p.at, fit_radius * in_.surface.rho, matches);
  if (matches.empty()) return {};
  std::ranges::sort(matches, [](const auto& a, const auto& b) {
    return std::pair(a.second, a.first) < std::pair(b.second, b.first);
  });
  return interpolated(p, radius, matches);
}

// Keeps only the points within the radius that are on the same side of all outlines as p. Points on an outline are
// left out, because they may belong to either side. Noise moves some points across an outline. So points are also
// left out if there is a jump between them and the point that is farthest from all outlines.
void SideInterpolation::leave_same_side(const RowPoint& p, double radius, Around& around) const {
  const auto on_outline = static_cast<float>(half_wall * in_.surface.rho);
  std::vector<Match>& matches = around.matches;
  Index safest = no_index;
  around.lines.begin(in_.grid, p.seen_from, radius + (p.seen_from - p.at).norm());
  std::erase_if(matches, [&](const auto& m) {
    const float distance = in_.outline_distance[m.first];
    if (distance < on_outline) return true;
    const Vec2& place = in_.plane.places[m.first];
    constexpr double rounding = 1e-6;
    // The distance is infinite at points far from outlines and at points outside.
    const bool is_clear = std::isfinite(distance) &&
                          (place - p.seen_from).norm() < (1 - rounding) * static_cast<double>(distance);
    if (!is_clear && around.lines.is_crossed(place)) return true;
    if (safest == no_index || distance > in_.outline_distance[safest]) safest = m.first;
    return false;
  });
  std::erase_if(matches,
                [&](const auto& m) { return m.first != safest && is_jump(in_.surface, safest, m.first); });
  leave_same_face(matches);
}

// If a crease separates the points, keeps only those on the same face as the nearest point, unless those are
// too few.
void SideInterpolation::leave_same_face(std::vector<Match>& matches) const {
  if (matches.empty()) return;
  const Index nearest = std::ranges::min_element(matches, {}, &Match::second)->first;
  const auto is_other = [&](const auto& m) {
    return in_.surface.normals[m.first].dot(in_.surface.normals[nearest]) < least_likeness;
  };
  const std::ptrdiff_t others = std::ranges::count_if(matches, is_other);
  if (static_cast<std::ptrdiff_t>(matches.size()) - others >= least_face_points)
    std::erase_if(matches, is_other);
}

SideInterpolation::Value SideInterpolation::interpolated(const RowPoint& p, double radius,
                                                         std::span<const Match> matches) const {
  LinearField<3> field(p.at, radius);
  for (const auto& [j, distance_sq] : matches) {
    const Vec3f& n = in_.surface.normals[j];
    field.add(in_.plane.places[j],
              Vec3(static_cast<double>(n.x()), static_cast<double>(n.y()), in_.measures.k[j]));
  }
  const auto fit = field.fitted();
  Value value;
  value.is_known = true;
  const Vec3 normal = normal_with(fit.value.head<2>());
  value.normal = normal.cast<float>();
  value.k = std::clamp(fit.value.z(), -1 / in_.surface.rho, 1 / in_.surface.rho);
  value.point << p.at, depth_at(p.at, normal, matches);
  const Index nearest = matches.front().first;
  if (!in_.surface.colours.empty()) value.colour = in_.surface.colours[nearest];
  if (!in_.surface.own_heights.empty()) value.own_height = in_.surface.own_heights[nearest];
  if (!in_.measures.spacing.empty()) value.spacing = in_.measures.spacing[nearest];
  return value;
}

// Returns the mean of the depths that the nearest points predict at the position `at`. Each prediction assumes
// that the chord from the nearest point to the predicted point is perpendicular to the mean of the normals of
// these two points. This assumption is exact on circles.
double SideInterpolation::depth_at(const Vec2& at, const Vec3& normal, std::span<const Match> matches) const {
  const std::size_t count = std::min<std::size_t>(6, matches.size());
  double depths = 0, weights = 0;
  for (std::size_t m = 0; m < count; ++m) {
    const auto& [j, distance_sq] = matches[m];
    const Vec3 mean = normal + in_.surface.normals[j].cast<double>();
    const double rise = -mean.head<2>().dot(at - in_.plane.places[j]) / std::max(mean.z(), 2 * least_nz);
    const double weight = 1 / (distance_sq + .01 * in_.surface.rho * in_.surface.rho);
    depths += weight * (in_.surface.points[j].z() + rise);
    weights += weight;
  }
  return depths / weights;
}

}  // namespace relievo
