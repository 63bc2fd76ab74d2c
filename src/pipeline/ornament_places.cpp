#include "relievo/ornament_places.h"

#include <utility>

#include "geometry/weld.h"
#include "lettering/ornament_shapes.h"
#include "pipeline/body.h"
#include "plate/plate_surface.h"
#include "relievo/core/within_memory.h"
#include "relievo/make_relief.h"
#include "relievo/plate/forms.h"
#include "relievo/scan/surface.h"

namespace relievo {
namespace {

Result<std::vector<Vec2>> first_outline(const Ornament& ornament, const OrnamentFrame& frame) {
  RELIEVO_TRY(std::vector<RaisedShape> shapes, ornament_shapes({&ornament, 1}, frame));
  return std::move(shapes[0].outlines[0]);
}

// Returns the ornament's position minus the position that it would have with at_mm = (0, 0).
std::optional<Vec2> shift_from_middle(const Ornament& ornament, const OrnamentFrame& frame) {
  Ornament in_middle = ornament;
  in_middle.at_mm = Vec2::Zero();
  const auto here = first_outline(ornament, frame), there = first_outline(in_middle, frame);
  if (!here || !there) return std::nullopt;
  Vec2 shift = here->front() - there->front();
  if (frame.is_mirrored) shift.x() = -shift.x();
  return shift;
}

OrnamentPlace place_of(const Ornament& ornament, const OrnamentFrame& frame, const Vec2& middle) {
  Result<std::vector<RaisedShape>> shapes = ornament_shapes({&ornament, 1}, frame);
  if (!shapes) return {.error = std::move(shapes).error()};
  OrnamentPlace place{std::move((*shapes)[0].outlines)};
  const bool has_place = ornament.kind == OrnamentKind::drawing ||
                         (ornament.kind == OrnamentKind::text && ornament.arc == TextArc::straight);
  if (has_place) place.at_mm = ornament.at_mm ? ornament.at_mm : shift_from_middle(ornament, frame);
  for (std::vector<Vec2>& outline : place.outlines)
    for (Vec2& p : outline) p -= middle;
  return place;
}

}  // namespace

Result<std::vector<OrnamentPlace>> ornament_places(const Surface& surface, const ReliefOptions& asked) {
  return within_memory({.points = surface.points.size()}, [&]() -> Result<std::vector<OrnamentPlace>> {
    RELIEVO_CHECK(check(asked));
    RELIEVO_TRY(const ReliefOptions options, with_width(surface, asked));
    HeightFieldMesh front =
        front_in_mm(surface, std::vector<double>(surface.points.size(), 0), mm_per_unit(surface, options));
    if (is_mirrored(options.form)) front = mirrored(std::move(front));
    const PlateOptions plate = plate_of(options, options.usual_height_mm());
    const PlateOutline outline = outline_of_plate(front, used_box(front.points, front.triangles), plate);
    const OrnamentFrame frame = ornament_frame(outline, plate);
    const Vec2 middle = Box::of(outline.polygon).centre().head<2>();
    std::vector<OrnamentPlace> places;
    for (const Ornament& ornament : plate.ornaments) places.push_back(place_of(ornament, frame, middle));
    return places;
  });
}

}  // namespace relievo
