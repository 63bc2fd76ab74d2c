#include "plate_of.h"

#include <algorithm>

namespace relievo {
namespace {

constexpr double bending_share = .25;  // of a tolerance, what a curved base may take
constexpr double rim_bevel = .3;       // of the rim's height: 17 degrees from upright, so dies come off

// The base that a form has: what is high is deep in a die.
BaseOptions base_of(const ReliefOptions& options, Form form) {
  BaseOptions base = *parse_base(options.base);
  base.image = options.base_image;
  base.is_mirrored = is_mirrored(form);
  base.is_hollow ^= form == Form::die;
  return base;
}

RimOptions rim_of(const ReliefOptions& options, Form form, double relief_mm) {
  if (!options.rim_mm) return {};
  const double width = *options.rim_mm, height = options.rim_height_mm.value_or(std::min(width, relief_mm)),
               bevel = std::min(width, options.rim_bevel_mm.value_or(rim_bevel * height));
  return {width, form == Form::die ? -height : height, bevel};
}

}  // namespace

PlateOptions plate_of(const ReliefOptions& options, Form form, double relief_mm) {
  PlateOptions plate{options.margin_mm,
                     options.thickness_mm,
                     *parse_outline(options.outline),
                     options.corner_mm,
                     rim_of(options, form, relief_mm),
                     base_of(options, form)};
  if (!options.tolerance_mm) return plate;
  plate.tolerance_mm = std::clamp(bending_share * *options.tolerance_mm, 1e-4, plate.tolerance_mm);
  const bool is_curved = plate.base.kind != BaseKind::plane || plate.wrap.kind != WrapKind::none;
  if (is_curved && plate.outline != Outline::none) plate.simplify_mm = front_tolerance(options);
  return plate;
}

bool is_mirrored(Form form) {
  return form == Form::mirror || form == Form::die;
}

double front_tolerance(const ReliefOptions& options) {
  const bool is_plane = parse_base(options.base)->kind == BaseKind::plane;
  return (is_plane ? 1 : 1 - bending_share) * *options.tolerance_mm;
}

}  // namespace relievo
