#include "plate/plate_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/weld.h"
#include "plate/height_field.h"
#include "plate/plate_ground.h"
#include "relievo/core/image.h"
#include "relievo/core/parallel.h"
#include "relievo/geometry/triangulation.h"
#include "relievo/scan/surface.h"

namespace relievo {
namespace {

// Distances between new points, counted in samples, where the surface is gentle and where it is steep. With
// the samples of samples_for(), these are usually a quarter and a twelfth of the tool's radius.
constexpr int gentle_stride = 3, steep_stride = 1;
constexpr float steep_slope = .5F;
constexpr double least_left_mm = 1e-3;  // a point counts as reached if at most this much is left above it
// Largest distance by which a point is lifted. A point that would have to be lifted more is removed.
constexpr double most_lift_mm = .01;

// The heights of a surface, and the heights that the tool leaves.
class ToolHeights {
 public:
  ToolHeights(Solid& surface, const Tool& tool) {
    surface.front_triangles = surface.triangles.size();
    field_ = front_samples(surface, used_box(surface.points, surface.triangles), tool);
    closed_ = close_by_tool(field_.z, field_.mm_per_pixel, tool);
  }

  int width() const { return closed_.width; }
  int height() const { return closed_.height; }
  double mm_per_sample() const { return field_.mm_per_pixel; }
  bool is_front(int x, int y) const { return closed_.contains(x, y) && !std::isnan(closed_.at(x, y)); }
  float left(int x, int y) const { return is_front(x, y) ? closed_.at(x, y) - field_.z.at(x, y) : 0; }
  Vec2 to_samples(const Vec3& point) const { return field_.to_pixels(point); }

  // Returns the position of a sample, at the height that the tool leaves.
  Vec3 place(int x, int y) const {
    const Vec2 place = field_.to_mm(x + .5, y + .5);
    return {place.x(), place.y(), field_.box.min.z() + static_cast<double>(closed_.at(x, y))};
  }

  // Returns how far the interpolated heights that the tool leaves are above a point. Outside all samples,
  // returns 0.
  double rise_at(const Vec3& point) const {
    return interpolated(point, [&](int x, int y) { return place(x, y).z() - point.z(); });
  }

  // Returns how much material the tool leaves above a point: the smaller of two values. At the foot of a wall
  // the first one is too large, because interpolated heights lie above the surface even if the tool leaves
  // nothing there. At the upper edge of a wall the second one, the interpolated difference between the
  // heights, is too large.
  double left_at(const Vec3& point) const {
    return std::min(rise_at(point),
                    interpolated(point, [&](int x, int y) { return static_cast<double>(left(x, y)); }));
  }

  // Returns the steepest slope from a sample to a neighbouring sample.
  float slope(int x, int y) const {
    float most = 0;
    for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}})
      if (is_front(x + dx, y + dy))
        most = std::max(most, std::abs(closed_.at(x + dx, y + dy) - closed_.at(x, y)));
    return most / static_cast<float>(field_.mm_per_pixel);
  }

  // Returns whether the tool leaves material at a sample, or at the samples `distance` away from it.
  bool leaves_near(int x, int y, int distance) const {
    for (const int dy : {-distance, 0, distance})
      for (const int dx : {-distance, 0, distance})
        if (static_cast<double>(left(x + dx, y + dy)) > least_left_mm) return true;
    return false;
  }

 private:
  struct Corner {
    int dx, dy;
    double weight;
  };

  // Returns the bilinear interpolation of value(x, y) between samples; 0 outside all samples.
  template <typename Value>
  double interpolated(const Vec3& point, const Value& value) const {
    const Vec2 place = to_samples(point) - Vec2(.5, .5);
    const int x = static_cast<int>(std::floor(place.x())), y = static_cast<int>(std::floor(place.y()));
    const double right = place.x() - x, down = place.y() - y;
    double sum = 0, weights = 0;
    for (const auto& [dx, dy, weight] :
         {Corner{0, 0, (1 - right) * (1 - down)}, Corner{1, 0, right * (1 - down)},
          Corner{0, 1, (1 - right) * down}, Corner{1, 1, right * down}}) {
      if (!is_front(x + dx, y + dy)) continue;
      sum += weight * value(x + dx, y + dy);
      weights += weight;
    }
    return weights > 0 ? sum / weights : 0;
  }

  HeightField field_;
  Image<float> closed_;
};

// The points of the new surface. The samples close to these points are marked, so that they are not added.
class PointSet {
 public:
  PointSet(const ToolHeights& heights, const Solid& old)
      : heights_(heights),
        old_(old),
        is_taken_(filled_image(heights.width(), heights.height(), std::uint8_t{0})) {}

  std::vector<Vec3> points;
  std::vector<Colour> colours;

  void add(const Vec3& point, const Colour& colour) {
    points.push_back(point);
    if (!old_.colours.empty()) colours.push_back(colour);
    const Vec2 place = heights_.to_samples(point);
    const int column = static_cast<int>(place.x()), row = static_cast<int>(place.y());
    for (int y = row - 1; y <= row + 1; ++y)
      for (int x = column - 1; x <= column + 1; ++x)
        if (is_taken_.contains(x, y)) is_taken_.at(x, y) = 1;
  }

  // Adds the point if the tool reaches it. If the tool misses the point by little, the point is lifted and added.
  void add_if_reached(const Vec3& point, const Colour& colour) {
    const double left = heights_.left_at(point);
    if (left <= least_left_mm)
      add(point, colour);
    else if (left <= most_lift_mm)
      add(point + Vec3(0, 0, left), colour);
  }

  void add_samples() {
    const Image8 taken = is_taken_;
    for (int y = 0; y < heights_.height(); ++y)
      for (int x = 0; x < heights_.width(); ++x) {
        const bool is_coarse = x % gentle_stride == 0 && y % gentle_stride == 0;
        if (!heights_.is_front(x, y) || taken.at(x, y) != 0) continue;
        if (!is_coarse && !(heights_.slope(x, y) > steep_slope)) continue;
        if (heights_.leaves_near(x, y, is_coarse ? gentle_stride : steep_stride))
          add(heights_.place(x, y), plate_colour);
      }
  }

 private:
  const ToolHeights& heights_;
  const Solid& old_;
  Image8 is_taken_;
};

Colour colour_of(const Solid& solid, Index i) {
  return solid.colours.empty() ? Colour{} : solid.colours[i];
}

// Returns the distance between points along the rim's edges. It is a third of the least distance between two
// edges, so that no triangle crosses the bevel. But it is at least the width of two samples.
double edge_spacing(const ToolHeights& heights, std::span<const RimEdge> edges) {
  double narrowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < edges.size(); ++i)
    narrowest = std::min(narrowest, (edges[i].polygon[0] - edges[i - 1].polygon[0]).norm());
  return std::max(narrowest / 3, 2 * heights.mm_per_sample());
}

// Returns the points of the new surface, which is the one that the tool leaves. The points along `edges` must lie on the
// old surface, because ToolHeights::left_at() compares points with that.
PointSet reached_points(const PlateSurface& surface, const ToolHeights& heights,
                        std::span<const RimEdge> edges) {
  const Solid& solid = surface.solid;
  PointSet set(heights, solid);
  // The outline comes first, because the walls are built on it.
  std::vector<std::uint8_t> is_free = used_points(solid.points.size(), solid.triangles);
  for (const Index i : surface.outline) {
    set.add(solid.points[i], colour_of(solid, i));
    is_free[i] = 0;
  }
  for (Index i = 0; i < solid.points.size(); ++i)
    if (is_free[i]) set.add_if_reached(solid.points[i], colour_of(solid, i));
  const double spacing = edge_spacing(heights, edges);
  for (const RimEdge& edge : edges)
    for (const Vec2& p : subdivided(edge.polygon, spacing))
      set.add_if_reached({p.x(), p.y(), solid.ground_mm + edge.height_mm}, plate_colour);
  set.add_samples();
  return set;
}

void close_once(PlateSurface& surface, const Tool& tool, std::span<const RimEdge> edges) {
  const ToolHeights heights(surface.solid, tool);
  PointSet set = reached_points(surface, heights, edges);
  Triangulation mesh = delaunay(in_plane(set.points));
  surface.solid.points = std::move(set.points);
  surface.solid.colours = std::move(set.colours);
  surface.solid.triangles = std::move(mesh.triangles);
  surface.outline = std::move(mesh.hull);
}

}  // namespace

void make_reachable(PlateSurface& surface, const Tool& tool, std::span<const RimEdge> edges) {
  if (surface.outline.empty()) {
    const ToolHeights heights(surface.solid, tool);
    parallel_for(surface.solid.points.size(), [&](std::size_t i) {
      Vec3& p = surface.solid.points[i];
      p.z() += std::max(0., heights.rise_at(p));
    });
    return;
  }
  // The triangles of the first pass can lie below the surface that the tool leaves. A second pass raises them
  // (docs/decisions/tool.md).
  close_once(surface, tool, edges.first(edges.size() - 1));  // the last edge is the outline
  close_once(surface, tool, {});                             // the edges that the tool reaches are points now
}

}  // namespace relievo
