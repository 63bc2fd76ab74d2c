#include <algorithm>
#include <cmath>
#include <utility>

#include "ground_mesh.h"
#include "plate/plate_checks.h"
#include "plate_top.h"
#include "relievo/plate/solid.h"
#include "silhouette.h"
#include "twins.h"

namespace relievo {
namespace {

// Moves the top until its lowest point lies at the thickness, bit for bit, and its box begins at 0.
void raise(Solid& top, double thickness_mm) {
  const Vec3 begin = used_box(top.points, top.triangles).min;
  const Vec3 move(-std::min(0.0, begin.x()), -std::min(0.0, begin.y()), thickness_mm - begin.z());
  for (Vec3& p : top.points) p = {p.x() + move.x(), p.y() + move.y(), (p.z() - begin.z()) + thickness_mm};
  top.shift += move;
  top.ground_mm += move.z();
}

Loop add_below(Solid& solid, const Loop& top) {
  Loop bottom;
  for (const Index i : top) {
    bottom.push_back(static_cast<Index>(solid.points.size()));
    const Vec3 p = solid.points[i];
    solid.points.emplace_back(p.x(), p.y(), 0);
  }
  return bottom;
}

void add_walls(Solid& solid, const Loop& top, const Loop& bottom) {
  for (std::size_t i = 0; i < top.size(); ++i) {
    const std::size_t next = (i + 1) % top.size();
    solid.triangles.push_back({bottom[i], bottom[next], top[next]});
    solid.triangles.push_back({bottom[i], top[next], top[i]});
  }
}

void close_plate(Solid& solid, const Loop& outline, double spacing) {
  solid.front_triangles = solid.triangles.size();
  const Loop bottom = add_below(solid, outline);
  add_walls(solid, outline, bottom);
  if (std::isfinite(spacing)) return fill_below(solid, bottom, spacing);
  for (std::size_t i = 1; i + 1 < bottom.size(); ++i)
    solid.triangles.push_back({bottom[0], bottom[i + 1], bottom[i]});
}

// The top's triangles once more below, and walls between the two along its rim.
void close_body(Solid& solid) {
  const std::vector<Triangle> front = solid.triangles;
  solid.front_triangles = front.size();
  const auto n = static_cast<Index>(solid.points.size());
  for (Index i = 0; i < n; ++i) solid.points.emplace_back(solid.points[i].x(), solid.points[i].y(), 0);
  for (const auto& [a, b] : rim_of(front)) {
    solid.triangles.push_back({a + n, b + n, b});
    solid.triangles.push_back({a + n, b, a});
  }
  for (const auto& [a, b, c] : front) solid.triangles.push_back({a + n, c + n, b + n});
}

Solid closed(Top top, const PlateOptions& options) {
  raise(top.solid, options.thickness_mm);
  const double highest = used_box(top.solid.points, top.solid.triangles).max.z();
  if (options.outline == Outline::none)
    close_body(top.solid);
  else
    close_plate(top.solid, top.outline, top.spacing);
  separate_twins(top.solid, (highest + options.thickness_mm) / 2);
  fill_colours(top.solid);
  return std::move(top.solid);
}

// The front as the plate shows it: without ground, it is the relief alone.
Result<Front> front_shown(const Front& front, const PlateOptions& options) {
  if (auto good = check_plate(front, options); !good) return std::unexpected(good.error());
  if (options.outline != Outline::none) return front;
  Front alone = relief_alone(front);
  if (!alone.triangles.empty()) return alone;
  return plate_error(ErrorKind::geometry, "front", "expected triangles of the relief, found ground only");
}

}  // namespace

Result<Base> plate_base(const Front& front, const PlateOptions& options) {
  const Result<Front> shown = front_shown(front, options);
  if (!shown) return std::unexpected(shown.error());
  return base_of(*shown, options);
}

Result<Solid> make_plate(const Front& front, const PlateOptions& options) {
  const Result<Front> shown = front_shown(front, options);
  if (!shown) return std::unexpected(shown.error());
  const Result<Base> base = base_of(*shown, options);
  if (!base) return std::unexpected(base.error());
  Result<Top> top = make_top(*shown, *base, options);
  if (!top) return std::unexpected(top.error());
  return closed(std::move(*top), options);
}

}  // namespace relievo
