#include "scan/outlines/mesh_outlines.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/groups.h"
#include "geometry/plane.h"
#include "geometry/weld.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// The length, in pixels, of the segments into which edges are divided. Each segment is visible or hidden as a whole.
constexpr double segment_length = .5;
constexpr double just_beyond =
    1e-3;                         // in pixels; distance from an edge at which the surface behind it is sought
constexpr double least_jump = 1;  // least depth difference at a jump, in pixels

// An edge that has more triangles on its left than on its right, as seen by the viewer.
struct ContourEdge {
  Index from, to;
};

// Returns the edges that have more triangles on one side than on the other. Triangles without area in the
// view plane are ignored.
std::vector<ContourEdge> contour_edges(std::span<const Vec3> points, std::span<const Triangle> triangles) {
  struct Side {
    Index higher;
    int direction;  // 1 if the triangle's edge begins at the point with the lower index, else -1
  };
  const std::vector<Index> place = first_coincident(points);
  const auto sides = grouped<Side, std::size_t>(points.size(), [&](auto&& add) {
    for (const Triangle& t : triangles) {
      const auto at = [&](std::size_t i) -> Vec2 { return points[t[i]].head<2>(); };
      if (!(twice_area(at(0), at(1), at(2)) > 0)) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = place[t[i]], b = place[t[(i + 1) % 3]];
        if (a != b) add(std::min(a, b), Side{std::max(a, b), a < b ? 1 : -1});
      }
    }
  });
  std::vector<ContourEdge> edges;
  std::vector<Side> around;
  for (Index low = 0; low < points.size(); ++low) {
    around.assign(sides[low].begin(), sides[low].end());
    std::ranges::sort(around, {}, &Side::higher);
    for (std::size_t s = 0; s < around.size();) {
      const Index high = around[s].higher;
      int sum = 0;
      for (; s < around.size() && around[s].higher == high; ++s) sum += around[s].direction;
      if (sum > 0) edges.push_back({low, high});
      if (sum < 0) edges.push_back({high, low});
    }
  }
  return edges;
}

// Finds the depth of the nearest surface at positions that are known in advance. A grid lists, for each cell
// that contains such a position, the triangles over that cell.
class DepthLookup {
 public:
  DepthLookup(std::span<const Vec3> points, std::span<const Triangle> triangles, std::span<const Vec2> places,
              double cell)
      : points_(points), triangles_(triangles), cell_(cell) {
    if (places.empty()) return;
    Vec2 low = places[0], high = low;
    for (const Vec2& p : places) low = low.cwiseMin(p), high = high.cwiseMax(p);
    constexpr double most_cells = 4096;  // cells per side of the grid
    cell_ = std::max(cell_, (high - low).maxCoeff() / most_cells);
    low_ = low;
    width_ = static_cast<int>((high.x() - low.x()) / cell_) + 1;
    height_ = static_cast<int>((high.y() - low.y()) / cell_) + 1;
    std::vector<std::uint8_t> is_asked(static_cast<std::size_t>(width_) * height_, 0);
    for (const Vec2& p : places) is_asked[cell_of(p)] = 1;
    in_cell_ = grouped<Index, std::size_t>(is_asked.size(), [&](auto&& add) {
      for (Index t = 0; t < triangles.size(); ++t)
        each_cell(triangles[t], [&](std::size_t at) {
          if (is_asked[at]) add(at, t);
        });
    });
  }

  // Returns the depth of the nearest surface; minus infinity where there is none.
  double depth(const Vec2& place) const {
    double nearest = -std::numeric_limits<double>::infinity();
    for (const Index t : in_cell_[cell_of(place)]) {
      const auto& [a, b, c] = triangles_[t];
      const auto at = [&](Index i) -> Vec2 { return points_[i].head<2>() - place; };
      const double wa = cross(at(b), at(c)), wb = cross(at(c), at(a)), wc = cross(at(a), at(b));
      const double area = wa + wb + wc;
      if (wa < 0 || wb < 0 || wc < 0 || !(area > 0)) continue;
      nearest = std::max(nearest, (wa * points_[a].z() + wb * points_[b].z() + wc * points_[c].z()) / area);
    }
    return nearest;
  }

 private:
  std::size_t cell_of(const Vec2& place) const {
    return static_cast<std::size_t>(row_of(place.y())) * width_ + column_of(place.x());
  }
  int column_of(double x) const { return index_of(x - low_.x(), width_); }
  int row_of(double y) const { return index_of(y - low_.y(), height_); }
  int index_of(double offset, int count) const {
    return static_cast<int>(std::clamp(std::floor(offset / cell_), 0.0, count - 1.0));
  }

  // Calls f for the cells over which the triangle lies. In each row these are the cells from the leftmost to the
  // rightmost part of the triangle in that row.
  template <typename F>
  void each_cell(const Triangle& t, F&& f) const {
    std::array<Vec2, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = points_[t[i]].head<2>();
    const auto [lowest, highest] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
    for (int row = row_of(lowest); row <= row_of(highest); ++row) {
      // Positions outside the grid belong to its outermost cells.
      const double bottom = row == 0 ? lowest : low_.y() + row * cell_,
                   top = row == height_ - 1 ? highest : low_.y() + (row + 1) * cell_;
      double left = std::numeric_limits<double>::infinity(), right = -left;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec2 &a = p[i], &b = p[(i + 1) % 3];
        const auto extend = [&](double y) {
          const double share = a.y() == b.y() ? 0 : std::clamp((y - a.y()) / (b.y() - a.y()), 0.0, 1.0);
          const double x = a.x() + share * (b.x() - a.x());
          left = std::min(left, x), right = std::max(right, x);
        };
        if (std::max(a.y(), b.y()) < bottom || std::min(a.y(), b.y()) > top) continue;
        extend(bottom), extend(top);
        if (a.y() == b.y()) extend(a.y()), left = std::min(left, b.x()), right = std::max(right, b.x());
      }
      if (!(left <= right)) continue;
      const double slack = 1e-6 * cell_;
      for (int column = column_of(left - slack); column <= column_of(right + slack); ++column)
        f(static_cast<std::size_t>(row) * width_ + column);
    }
  }

  std::span<const Vec3> points_;
  std::span<const Triangle> triangles_;
  double cell_;
  Vec2 low_ = Vec2::Zero();
  int width_ = 0, height_ = 0;
  Groups<Index, std::size_t> in_cell_;
};

enum class Beyond : std::uint8_t { surface, nothing, jump };

// A part of an edge, and the kind of surface beyond its midpoint.
struct ContourSegment {
  Vec3 from, to;
  Index edge;
  Beyond beyond = Beyond::surface;
};

std::vector<ContourSegment> segments_of(std::span<const Vec3> points, const std::vector<ContourEdge>& edges,
                                        double length) {
  std::vector<ContourSegment> segments;
  for (Index e = 0; e < edges.size(); ++e) {
    const Vec3 &a = points[edges[e].from], &b = points[edges[e].to];
    const double seen = (b - a).head<2>().norm();
    if (!(seen > 0)) continue;
    const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(seen / length)));
    for (std::size_t k = 0; k < count; ++k) {
      const double begin = static_cast<double>(k) / static_cast<double>(count),
                   end = static_cast<double>(k + 1) / static_cast<double>(count);
      segments.push_back({a + begin * (b - a), k + 1 == count ? b : Vec3(a + end * (b - a)), e});
    }
  }
  return segments;
}

// Returns a position at this distance to the right of a segment's midpoint.
Vec2 place_beyond(const ContourSegment& segment, double distance) {
  const Vec2 middle = (segment.from + segment.to).head<2>() / 2,
             step = (segment.to - segment.from).head<2>().normalized();
  return middle + distance * Vec2(step.y(), -step.x());
}

void look_beyond(std::span<const Vec3> points, std::span<const Triangle> triangles, double pixel,
                 std::vector<ContourSegment>& segments) {
  std::vector<Vec2> places(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i)
    places[i] = place_beyond(segments[i], just_beyond * pixel);
  const DepthLookup lookup(points, triangles, places, 2 * pixel);
  parallel_for(
      segments.size(),
      [&](std::size_t i) {
        const double own = (segments[i].from.z() + segments[i].to.z()) / 2, behind = lookup.depth(places[i]);
        if (behind == -std::numeric_limits<double>::infinity())
          segments[i].beyond = Beyond::nothing;
        else if (behind < own - least_jump * pixel)
          segments[i].beyond = Beyond::jump;
      },
      64);
}

}  // namespace

std::vector<OutlineSegment> seen_outlines(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                          double pixel) {
  std::vector<ContourSegment> segments =
      segments_of(points, contour_edges(points, triangles), segment_length * pixel);
  look_beyond(points, triangles, pixel, segments);
  std::vector<OutlineSegment> outlines;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const ContourSegment& segment = segments[i];
    if (segment.beyond == Beyond::surface) continue;
    const bool continues =
        i > 0 && segments[i - 1].edge == segment.edge && segments[i - 1].beyond == segment.beyond;
    if (continues)
      outlines.back().to = segment.to;
    else
      outlines.push_back({segment.from, segment.to, segment.beyond == Beyond::jump});
  }
  return outlines;
}

}  // namespace relievo
