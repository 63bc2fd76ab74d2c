#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/plane.h"
#include "plate/height_field.h"
#include "plate/silhouette.h"
#include "relievo/core/image.h"
#include "relievo/core/parallel.h"
#include "relievo/geometry/triangulation.h"
#include "relievo/plate/tool.h"

namespace relievo {
namespace {

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
constexpr int least_samples = 2048, most_samples = 4096;  // of the longer side
constexpr double samples_per_radius = 12;
constexpr double least_reach_tolerance_mm = .01;
constexpr Colour ground_colour = {200, 200, 200};

int samples_for(const Tool& tool, double longer_mm) {
  const double radius = (tool.kind == Tool::Kind::v ? tool.tip_mm : tool.diameter_mm) / 2;
  if (!(radius > 0)) return least_samples;
  const double wanted = longer_mm / radius * samples_per_radius;
  return static_cast<int>(std::clamp<double>(std::ceil(wanted), least_samples, most_samples));
}

// Sums over samples, block by block.
struct Count {
  std::size_t front = 0, reached = 0;
  float largest = 0;
};

Count count_reached(const Image<float>& residual, double tolerance_mm) {
  return parallel_reduce(
      residual.pixels.size(), Count{},
      [&](std::size_t begin, std::size_t end) {
        Count count;
        for (std::size_t i = begin; i < end; ++i) {
          const float left = residual.pixels[i];
          if (left != left) continue;
          ++count.front;
          count.reached += static_cast<double>(left) <= tolerance_mm;
          count.largest = std::max(count.largest, left);
        }
        return count;
      },
      [](const Count& a, const Count& b) {
        return Count{a.front + b.front, a.reached + b.reached, std::max(a.largest, b.largest)};
      });
}

Image<float> difference(const Image<float>& a, const Image<float>& b) {
  Image<float> out = a;
  for (std::size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] -= b.pixels[i];
  return out;
}

// Gives the samples beside the front that height.
void fill_beside(HeightField& field, float height) {
  for (std::size_t i = 0; i < field.z.pixels.size(); ++i)
    if (field.is_beside.pixels[i] != 0) field.z.pixels[i] = height;
}

// The heights that the tool leaves above a front, sampled over its box and as far beyond as the tool reaches.
class Leavings {
 public:
  Leavings(const HeightFieldMesh& front, const Tool& tool) {
    Solid solid{front.points, relief_triangles(front), 0};
    solid.front_triangles = solid.triangles.size();
    Box box;
    for (const Triangle& t : solid.triangles)
      for (const Index i : t) box.extend(front.points[i]);
    field_ = draw_height_field(solid, samples_for(tool, box.longer_side()));
    const auto around = front.is_relief.empty() ? static_cast<float>(front.ground_mm - box.min.z()) : nothing;
    fill_beside(field_, around);
    left_ = difference(close_by_tool(field_.z, field_.mm_per_pixel, tool), field_.z);
  }

  int width() const { return field_.z.width; }
  int height() const { return field_.z.height; }
  double mm_per_sample() const { return field_.mm_per_pixel; }

  float at(int x, int y) const {
    if (!left_.contains(x, y)) return 0;
    const float left = left_.at(x, y);
    return left == left ? left : 0;
  }

  // Between samples.
  double at(const Vec3& point) const {
    const Vec2 place = field_.to_pixels(point) - Vec2(.5, .5);
    const double x = std::floor(place.x()), y = std::floor(place.y());
    const double right = place.x() - x, down = place.y() - y;
    const auto sample = [&](int dx, int dy) {
      return static_cast<double>(at(static_cast<int>(x) + dx, static_cast<int>(y) + dy));
    };
    return (1 - down) * ((1 - right) * sample(0, 0) + right * sample(1, 0)) +
           down * ((1 - right) * sample(0, 1) + right * sample(1, 1));
  }

  Vec2 to_samples(const Vec3& point) const { return field_.to_pixels(point); }

  // Returns whether a sample shows the front.
  bool is_front(int x, int y) const { return field_.is_beside.at(x, y) == 0; }

  // The front at a sample.
  Vec3 place(int x, int y) const {
    const Vec2 middle = field_.box.centre().head<2>(),
               place = middle + field_.mm_per_pixel * Vec2(x + .5 - width() / 2.0, height() / 2.0 - y - .5);
    return {place.x(), place.y(), field_.box.min.z() + static_cast<double>(field_.z.at(x, y))};
  }

 private:
  HeightField field_;
  Image<float> left_;
};

// Lifts points above a front by no more than they are away from its hull, which stays where it is.
class AtHull {
 public:
  explicit AtHull(const HeightFieldMesh& front) : front_(front) {}

  double lift(const Vec3& point, double wanted) const {
    if (!(wanted > 0)) return 0;
    double nearest = wanted;
    for (std::size_t i = 0; i < front_.hull.size(); ++i) {
      const Vec2 a = front_.points[front_.hull[i]].head<2>(),
                 b = front_.points[front_.hull[(i + 1) % front_.hull.size()]].head<2>();
      const Vec2 along = (b - a).normalized(), to = point.head<2>() - a;
      nearest = std::min(nearest, cross(along, to));
    }
    return std::max(0.0, nearest);
  }

 private:
  const HeightFieldMesh& front_;
};

// The samples that a point of the front lies in or next to.
Image8 near_points(const Leavings& leavings, const std::vector<Vec3>& points) {
  Image8 is_near = filled_image(leavings.width(), leavings.height(), std::uint8_t{0});
  for (const Vec3& p : points) {
    const Vec2 place = leavings.to_samples(p);
    const int column = static_cast<int>(place.x()), row = static_cast<int>(place.y());
    for (int y = row - 1; y <= row + 1; ++y)
      for (int x = column - 1; x <= column + 1; ++x)
        if (is_near.contains(x, y)) is_near.at(x, y) = 1;
  }
  return is_near;
}

// Points of what the tool leaves, and around there, where the front has none: few where it is level.
std::vector<Vec3> points_left(const Leavings& leavings, const HeightFieldMesh& front) {
  const Image8 is_near = near_points(leavings, front.points);
  const AtHull at_hull(front);
  constexpr int stride = 3;  // a quarter of the radius of a tool that samples_for() can follow
  constexpr float least_mm = 1e-3F;
  std::vector<Vec3> points;
  for (int y = stride; y + stride < leavings.height(); y += stride)
    for (int x = stride; x + stride < leavings.width(); x += stride) {
      if (!leavings.is_front(x, y) || is_near.at(x, y) != 0) continue;
      float most = 0;
      for (const int dy : {-stride, 0, stride})
        for (const int dx : {-stride, 0, stride}) most = std::max(most, leavings.at(x + dx, y + dy));
      if (!(most > least_mm)) continue;
      Vec3 place = leavings.place(x, y);
      place.z() += at_hull.lift(place, static_cast<double>(leavings.at(x, y)));
      points.push_back(place);
    }
  return points;
}

}  // namespace

ToolReach measure_reach(const Solid& solid, const Tool& tool) {
  Box box;
  for (const Triangle& t : std::span(solid.triangles).first(solid.front_triangles))
    for (const Index i : t) box.extend(solid.points[i]);
  ToolReach reach;
  if (box.is_empty()) return reach;
  HeightField field = draw_height_field(solid, samples_for(tool, box.longer_side()));
  fill_beside(field, nothing);
  reach.mm_per_sample = field.mm_per_pixel;
  reach.tolerance_mm = std::max(least_reach_tolerance_mm, field.mm_per_pixel / 8);
  reach.heights_mm = std::move(field.z);
  reach.residual_mm =
      difference(close_by_tool(reach.heights_mm, reach.mm_per_sample, tool), reach.heights_mm);
  const Count count = count_reached(reach.residual_mm, reach.tolerance_mm);
  reach.largest_residual_mm = static_cast<double>(count.largest);
  if (count.front > 0)
    reach.reached_share = static_cast<double>(count.reached) / static_cast<double>(count.front);
  return reach;
}

Result<HeightFieldMesh> reachable_front(const HeightFieldMesh& front, const Tool& tool) {
  if (front.triangles.empty() || front.hull.size() < 3)
    return std::unexpected(
        Error{ErrorKind::geometry, "front", {}, "expected triangles and a hull around them, found none"});
  const Leavings leavings(front, tool);
  HeightFieldMesh out = front;
  const AtHull at_hull(front);
  parallel_for(out.points.size(), [&](std::size_t i) {
    out.points[i].z() += at_hull.lift(front.points[i], leavings.at(front.points[i]));
  });
  if (!front.is_relief.empty()) return out;  // its rim would have to be found anew
  const std::vector<Vec3> added = points_left(leavings, front);
  if (added.empty()) return out;
  out.points.insert(out.points.end(), added.begin(), added.end());
  if (!out.colours.empty()) out.colours.resize(out.points.size(), ground_colour);
  std::vector<Vec2> plane;
  for (const Vec3& p : out.points) plane.push_back(p.head<2>());
  Triangulation mesh = delaunay(plane);
  out.triangles = std::move(mesh.triangles);
  out.hull = std::move(mesh.hull);
  return out;
}

}  // namespace relievo
