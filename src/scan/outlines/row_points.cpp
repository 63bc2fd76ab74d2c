#include "scan/outlines/row_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Distances of the rows from an outline, in rho. Only jumps have the first row.
constexpr std::array row_distance = {half_wall, .45, 1.0, 1.6, 2.25, last_row};
// Least distances, in rho, between points of rows; on outlines and in the row next to them they are less.
constexpr double least_between_rows = .4, least_in_first_row = .28, least_on_outlines = .12;
// The least distance of a wall from another outline, in rho. Walls end before they meet one.
constexpr double least_from_other_outline = .35;

// Makes the points of all rows, those nearest to the outlines first.
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
  // Returns the unit vector to the left of an outline at one of its points, longer at corners, so that a
  // parallel through its end has the distance 1.
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
    for (std::size_t k = 0; k < outline.curve.points.size(); ++k) {
      const Vec2 at = outline.curve.points[k];
      if (taken_.add(at, least_on_outlines * rho_))
        points_.push_back({at, at + .05 * rho_ * left_at(outline, k), Place::silhouette});
    }
  }

  // Adds a row on the left (side 1) or on the right (side -1) of an outline. Points of odd rows lie between
  // those of even ones.
  void add_row(Index c, std::size_t row, double side) {
    const OutlineCurve& outline = outlines_[c];
    const std::vector<Vec2>& p = outline.curve.points;
    const std::size_t n = p.size();
    const bool is_between = row % 2 == 1;
    const Place place = row > 0 ? Place::row : side > 0 ? Place::front : Place::back;
    const std::size_t count = is_between && !outline.is_closed ? n - 1 : n;
    std::vector<Candidate> candidates(count);
    parallel_for(
        count,
        [&](std::size_t k) {
          const Vec2 left =
              is_between ? (left_at(outline, k) + left_at(outline, (k + 1) % n)) / 2 : left_at(outline, k);
          const Vec2 from = is_between ? Vec2((p[k] + p[(k + 1) % n]) / 2) : p[k];
          const Vec2 at = from + row_distance[row] * rho_ * side * left;
          candidates[k] = {at, is_free(c, from + .02 * rho_ * side * left, at, row)};
        },
        64);
    const double apart = row == 0 ? least_on_outlines : row == 1 ? least_in_first_row : least_between_rows;
    for (const auto& [at, is_free] : candidates)
      if (is_free && taken_.add(at, apart * rho_)) points_.push_back({at, at, place});
  }

  struct Candidate {
    Vec2 at;
    bool is_free;
  };

  // Returns whether a place of a row is free: no outline separates it from its own outline, and none is too
  // near to it.
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
};

}  // namespace

std::vector<RowPoint> row_points(const std::vector<OutlineCurve>& outlines, const SegmentGrid& grid,
                                 double rho, PointSet& taken) {
  return RowMaker(outlines, grid, rho, taken).make();
}

}  // namespace relievo
