#include "pipeline/body.h"

#include <algorithm>
#include <cmath>

#include "plate/front/silhouette.h"
#include "relievo/core/text.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

// Converts the depths of a surface into heights above the ground.
class ValueScale {
 public:
  ValueScale(const Surface& surface, const ReliefOptions& options)
      : units_per_value_(surface.units_per_value.value_or(1)),
        centre_((surface.view.R_view_model * surface.centre).z()) {
    if (options.ground_value) {
      ground_ = *options.ground_value * sign();
    } else if (!surface.units_per_value || units_per_value_ < 0) {  // otherwise ground_ stays 0 (sea level)
      ground_ = HUGE_VAL;
      for (const Vec3& p : surface.points) ground_ = std::min(ground_, rising(p));
    }
  }

  // Returns how far the point's value is above the ground, in units of the file's values; 0 if it is below
  // the ground.
  double above_ground(const Vec3& p) const { return std::max(0., rising(p) - ground_); }

 private:
  // Returns the point's value, or its negative if values increase away from the viewer.
  double rising(const Vec3& p) const { return (p.z() + centre_) / std::abs(units_per_value_); }
  double sign() const { return std::copysign(1., units_per_value_); }

  double units_per_value_, centre_, ground_ = 0;
};

// A straight side of a convex hull.
struct HullSide {
  Vec2 place, inwards;
};

// Returns the sides of the hull. Neighbouring edges with nearly the same direction count as one side.
std::vector<HullSide> sides_of(const Surface& surface) {
  constexpr double same_direction = 1 - 1e-6;
  const std::vector<Index>& hull = surface.triangulation.hull;
  std::vector<HullSide> sides;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Vec2 a = surface.points[hull[k]].head<2>(),
               b = surface.points[hull[(k + 1) % hull.size()]].head<2>();
    const Vec2 along = (b - a).normalized(), inwards(-along.y(), along.x());
    if (sides.empty() || sides.back().inwards.dot(inwards) < same_direction) sides.push_back({a, inwards});
  }
  const bool is_closed = sides.size() > 1 && sides.front().inwards.dot(sides.back().inwards) > same_direction;
  if (is_closed) sides.pop_back();
  return sides;
}

// Returns the edges between the relief and its surroundings. The relief is on their left.
std::vector<BoundaryEdge> relief_edges(const Surface& surface) {
  std::vector<Triangle> inside;
  std::ranges::copy(triangles_inside(surface), std::back_inserter(inside));
  return boundary_edges(inside);
}

}  // namespace

std::vector<std::uint8_t> tile_edges(const Surface& surface) {
  constexpr double near = .01;  // distance from a side, in rho; rounding moves points off a straight side
  const std::vector<HullSide> sides = sides_of(surface);
  std::vector<std::uint8_t> is_on_side(surface.points.size());
  for (std::size_t i = 0; i < is_on_side.size(); ++i)
    is_on_side[i] =
        surface.boundary.is_boundary[i] && std::ranges::any_of(sides, [&](const HullSide& side) {
          return (surface.points[i].head<2>() - side.place).dot(side.inwards) < near * surface.rho;
        });
  // At a hole the relief goes down to the ground, so the points beside it do not belong to an edge of the
  // tile.
  std::vector<std::uint8_t> is_edge = is_on_side;
  for (const auto& [a, b] : relief_edges(surface))
    if (!is_on_side[a] || !is_on_side[b]) is_edge[a] = is_edge[b] = 0;
  return is_edge;
}

Result<Relief> relief_of_values(const Surface& surface, const ReliefOptions& options, double mm_per_unit) {
  if (surface.units_per_value == 0)
    return option_error("mm-per-value",
                        "expected one file of heights, or of depths without a camera, whose values are "
                        "proportional to heights; found other depths");
  const ValueScale scale(surface, options);
  const std::vector<std::uint8_t> is_edge = tile_edges(surface);
  Relief relief;
  relief.heights.resize(surface.points.size());
  for (std::size_t i = 0; i < relief.heights.size(); ++i)
    if (!surface.boundary.is_boundary[i] || is_edge[i])
      relief.heights[i] = *options.mm_per_value / mm_per_unit * scale.above_ground(surface.points[i]);
  relief.height = std::ranges::max(relief.heights);
  constexpr double most_mm = 1e5;
  const double height_mm = relief.height * mm_per_unit;
  if (height_mm > most_mm)
    return option_error("mm-per-value",
                        cat("expected at most ", *options.mm_per_value * most_mm / height_mm,
                            ", which makes a relief of ", most_mm, " mm, found ", *options.mm_per_value));
  if (relief.height > 0) return relief;
  return geometry_error("expected heights above the ground, found none; the option ground sets it lower");
}

void raise_walls(HeightFieldMesh& front, const Surface& surface) {
  constexpr double inset_mm = .01;  // single precision represents this distance on plates of up to 10 m
  const std::vector<std::uint8_t> is_edge = tile_edges(surface);
  const Box box = Box::of(front.points);
  const Vec2 centre = box.centre().head<2>(), size = box.size().head<2>();
  const double share = 1 - 2 * inset_mm / size.minCoeff();
  std::vector<Index> copies(front.points.size());
  for (Index i = 0; i < copies.size(); ++i) {
    copies[i] = i;
    if (!is_edge[i]) continue;
    copies[i] = static_cast<Index>(front.points.size());
    const Vec3 p = front.points[i];
    const Vec2 inside = centre + share * (p.head<2>() - centre);
    front.points.emplace_back(inside.x(), inside.y(), p.z());
    front.points[i].z() = front.ground_mm;
    if (!front.colours.empty()) front.colours.push_back(Colour(front.colours[i]));
  }
  for (std::size_t t = 0; t < front.triangles.size(); ++t)
    if (surface.boundary.is_inside[t])
      for (Index& i : front.triangles[t]) i = copies[i];
  for (const auto& [a, b] : relief_edges(surface)) {
    if (copies[a] != a) front.triangles.push_back({a, b, copies[a]});
    if (copies[b] != b) front.triangles.push_back({b, copies[b], copies[a]});
  }
}

}  // namespace relievo
