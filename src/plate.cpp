#include <algorithm>
#include <cmath>
#include <ranges>
#include <utility>

#include "convex_polygon.h"
#include "plate_rings.h"
#include "relievo/solid.h"
#include "relievo/text.h"
#include "silhouette.h"
#include "twins.h"

namespace relievo {
namespace {

// Below a micrometre the files' single precision could no longer tell the ring or the walls from a line.
constexpr double least_size_mm = 1e-3;

constexpr Colour plate_colour = {200, 200, 200};  // of the ground, walls and bottom of a coloured relief

std::unexpected<Error> fail(ErrorKind kind, std::string input, std::string expected) {
  return std::unexpected(Error{kind, std::move(input), {}, std::move(expected)});
}

bool is_good(double mm) {
  return std::isfinite(mm) && mm >= least_size_mm;
}

std::string wanted_length(double mm) {
  return cat("expected a finite length of at least 0.001 mm, found ", mm);
}

Result<void> check_rim(const PlateOptions& options) {
  const RimOptions& rim = options.rim;
  if (rim.width_mm == 0) return {};
  if (options.outline == Outline::none)
    return fail(ErrorKind::option, "rim", "expected an outline to lie along, found none");
  if (!is_good(rim.width_mm)) return fail(ErrorKind::option, "rim", wanted_length(rim.width_mm));
  if (!is_good(std::abs(rim.height_mm)))
    return fail(ErrorKind::option, "rim-height", wanted_length(rim.height_mm));
  if (!is_good(rim.bevel_mm) || rim.bevel_mm > rim.width_mm)
    return fail(
        ErrorKind::option, "rim-bevel",
        cat("expected 0.001 mm to ", rim.width_mm, " mm, the rim's width, found ", rim.bevel_mm, " mm"));
  return {};
}

Result<void> check_options(const PlateOptions& options) {
  if (!is_good(options.margin_mm)) return fail(ErrorKind::option, "margin", wanted_length(options.margin_mm));
  if (!is_good(options.thickness_mm))
    return fail(ErrorKind::option, "thickness", wanted_length(options.thickness_mm));
  if (options.outline == Outline::round && !is_good(options.corner_mm))
    return fail(ErrorKind::option, "corner", wanted_length(options.corner_mm));
  return check_rim(options);
}

Result<void> check_front(const Front& front, bool has_ground) {
  const auto is_bad = [&](Index i) { return i >= front.points.size() || !front.points[i].allFinite(); };
  const auto has_bad_corner = [&](const Triangle& t) { return std::ranges::any_of(t, is_bad); };
  if (front.triangles.empty() || (has_ground && front.hull.size() < 3))
    return fail(ErrorKind::geometry, "front", "expected triangles and a hull around them, found none");
  if (std::ranges::any_of(front.triangles, has_bad_corner) || std::ranges::any_of(front.hull, is_bad))
    return fail(ErrorKind::geometry, "front", "expected corners that are finite points of the front");
  if (!front.colours.empty() && front.colours.size() != front.points.size())
    return fail(ErrorKind::geometry, "front", "expected a colour for each point of the front, or none");
  if (!front.is_relief.empty() && front.is_relief.size() != front.triangles.size())
    return fail(ErrorKind::geometry, "front",
                "expected to know for each triangle if it is relief, or for none");
  return {};
}

Box used_box(const Front& front) {
  Box box;
  for (const Triangle& t : front.triangles)
    for (const Index i : t) box.extend(front.points[i]);
  return box;
}

// Adds the front's points to an empty solid, the corner of their box at `corner`.
void place_front(const Front& front, const Box& box, const Vec3& corner, Solid& solid) {
  solid.points.reserve(front.points.size() + 8);
  // Subtracting before adding keeps the box exact: the lowest point comes to lie at the thickness, bit for
  // bit.
  for (const Vec3& p : front.points) solid.points.push_back((p - box.min) + corner);
}

// A line along the outline where the ground bends.
struct Ledge {
  double inward_mm = 0, height_mm = 0;  // from the outline; above the ground
};

// From the outside in.
std::vector<Ledge> ledges_of(const RimOptions& rim) {
  if (rim.width_mm == 0) return {{}};
  std::vector<Ledge> ledges;
  const bool is_groove = rim.height_mm < 0;
  const double outer = is_groove ? rim.width_mm + rim.bevel_mm : 0;
  if (is_groove) ledges = {{0, 0}, {rim.width_mm, 0}};
  ledges.push_back({outer, rim.height_mm});
  if (rim.bevel_mm < rim.width_mm) ledges.push_back({outer + rim.width_mm - rim.bevel_mm, rim.height_mm});
  ledges.push_back({outer + rim.width_mm, 0});
  return ledges;
}

// The outline of a plate with ground, from the far, lower left corner of the plate's box; and where that of
// the front's box lies in it.
struct Ground {
  std::vector<Vec2> outline;
  Vec2 corner = Vec2::Zero();
};

Ground ground_around(const Front& front, const Box& box, const PlateOptions& options) {
  const double beyond_rim = ledges_of(options.rim).back().inward_mm - options.rim.width_mm;
  if (options.outline == Outline::rectangle) {
    const Vec2 corner = Vec2::Constant(options.margin_mm + options.rim.width_mm + beyond_rim),
               size = box.size().head<2>() + corner + corner;
    return {{{0, 0}, {size.x(), 0}, size, {0, size.y()}}, corner};
  }
  std::vector<Vec2> hull;
  for (const Index i : front.hull) hull.push_back((front.points[i] - box.min).head<2>());
  const double margin = options.margin_mm + options.rim.width_mm;
  Ground ground{inset(outline_around(hull, {options.outline, options.corner_mm, margin}), -beyond_rim)};
  Vec2 min = ground.outline[0];
  for (const Vec2& p : ground.outline) min = min.cwiseMin(p);
  for (Vec2& p : ground.outline) p -= min;
  ground.corner = -min;
  return ground;
}

void add_walls(Solid& solid, const Loop& top, const Loop& bottom) {
  for (std::size_t i = 0; i < top.size(); ++i) {
    const std::size_t next = (i + 1) % top.size();
    solid.triangles.push_back({bottom[i], bottom[next], top[next]});
    solid.triangles.push_back({bottom[i], top[next], top[i]});
  }
}

void add_bottom(Solid& solid, const Loop& loop) {
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    solid.triangles.push_back({loop[0], loop[i + 1], loop[i]});
}

Solid plate_with_ground(const Front& front, const PlateOptions& options) {
  Solid solid;
  Box box = used_box(front);
  const double ground_z = front.points[front.hull[0]].z();
  const std::vector<Ledge> ledges = ledges_of(options.rim);
  for (const Ledge& ledge : ledges) box.min.z() = std::min(box.min.z(), ground_z + ledge.height_mm);
  const Ground ground = ground_around(front, box, options);
  place_front(front, box, {ground.corner.x(), ground.corner.y(), options.thickness_mm}, solid);
  solid.triangles = front.triangles;
  Loop top = front.hull;
  for (const Ledge& ledge : ledges | std::views::reverse) {
    const double z = solid.points[front.hull[0]].z() + ledge.height_mm;
    Loop outer = add_loop(solid, inset(ground.outline, ledge.inward_mm), z);
    add_ring(solid, top, outer);
    top = std::move(outer);
  }
  solid.front_triangles = solid.triangles.size();
  const Loop bottom = add_loop(solid, ground.outline, 0);
  add_walls(solid, top, bottom);
  add_bottom(solid, bottom);
  return solid;
}

// The relief's triangles, the same below, and walls between the two along its rim.
Solid body_without_ground(const Front& alone, double thickness_mm) {
  Solid solid;
  place_front(alone, used_box(alone), {0, 0, thickness_mm}, solid);
  solid.triangles = alone.triangles;
  solid.front_triangles = alone.triangles.size();
  const auto n = static_cast<Index>(alone.points.size());
  for (Index i = 0; i < n; ++i) solid.points.emplace_back(solid.points[i].x(), solid.points[i].y(), 0);
  for (const auto& [a, b] : rim_of(alone.triangles)) {
    solid.triangles.push_back({a + n, b + n, b});
    solid.triangles.push_back({a + n, b, a});
  }
  for (const auto& [a, b, c] : alone.triangles) solid.triangles.push_back({a + n, c + n, b + n});
  return solid;
}

}  // namespace

Result<Solid> make_plate(const Front& front, const PlateOptions& options) {
  if (auto good = check_options(options); !good) return std::unexpected(good.error());
  const bool has_ground = options.outline != Outline::none;
  if (auto good = check_front(front, has_ground); !good) return std::unexpected(good.error());
  const Front alone = has_ground ? Front{} : relief_alone(front);
  if (!has_ground && alone.triangles.empty())
    return fail(ErrorKind::geometry, "front", "expected triangles of the relief, found ground only");
  const Front& shown = has_ground ? front : alone;
  Solid solid =
      has_ground ? plate_with_ground(front, options) : body_without_ground(alone, options.thickness_mm);
  separate_twins(solid, (options.thickness_mm + used_box(shown).size().z() + options.thickness_mm) / 2);
  solid.colours = shown.colours;
  if (!shown.colours.empty()) solid.colours.resize(solid.points.size(), plate_colour);
  return solid;
}

}  // namespace relievo
