#include "plate_of.h"

#include <algorithm>

#include "relievo/relief/draft.h"

namespace relievo {
namespace {

constexpr double bending_share = .25;  // of a tolerance, what a curved base may take
constexpr double rim_bevel = .3;       // of the rim's height: 17 degrees from upright, so dies come off

// Of the steepest slope, what simpler fronts keep: between that of limit_draft() and 1, which is left for
// rounding.
constexpr double front_share = .9995;
constexpr double most_held_mm = 1e-5;  // what hold_draft() moves points by, as a rule
constexpr double rounded_up = 1.002;   // bevels of curved rims are polygons, whose sides are steeper

// The base that a form has: what is high is deep in a die.
BaseOptions base_of(const ReliefOptions& options, Form form) {
  BaseOptions base = *parse_base(options.base);
  base.image = options.base_image;
  base.is_mirrored = is_mirrored(form);
  base.is_hollow ^= form == Form::die;
  return base;
}

// Its bevel leans as much as walls must.
RimOptions rim_of(const ReliefOptions& options, Form form, double relief_mm) {
  if (!options.rim_mm) return {};
  const double lean = options.draft_deg ? std::max(rim_bevel, least_bevel(1, *options.draft_deg)) : rim_bevel;
  const double width = *options.rim_mm, highest = std::min({width, width / lean, relief_mm}),
               height = options.rim_height_mm.value_or(highest),
               bevel = std::min(width, options.rim_bevel_mm.value_or(lean * height));
  return {width, form == Form::die ? -height : height, bevel};
}

}  // namespace

double least_bevel(double height_mm, double draft_deg) {
  return rounded_up * height_mm / slope_at_draft(draft_deg);
}

PlateOptions plate_of(const ReliefOptions& options, Form form, double relief_mm) {
  PlateOptions plate{options.margin_mm,
                     options.thickness_mm,
                     *parse_outline(options.outline),
                     options.corner_mm,
                     rim_of(options, form, relief_mm),
                     base_of(options, form),
                     *parse_wrap(options.wrap)};
  if (!options.tolerance_mm) return plate;
  plate.tolerance_mm = std::clamp(bending_share * *options.tolerance_mm, 1e-4, plate.tolerance_mm);
  const bool is_curved = plate.base.kind != BaseKind::plane || plate.wrap.kind != WrapKind::none;
  if (!is_curved || plate.outline == Outline::none) return plate;
  const SimplifyOptions simplest = simplest_front(options);
  plate.simplify_mm = simplest.tolerance_mm;
  plate.max_slope = simplest.max_slope;
  return plate;
}

bool is_mirrored(Form form) {
  return form == Form::mirror || form == Form::die;
}

SimplifyOptions simplest_front(const ReliefOptions& options) {
  const bool is_flat =
      parse_base(options.base)->kind == BaseKind::plane && parse_wrap(options.wrap)->kind == WrapKind::none;
  SimplifyOptions simplest{(is_flat ? 1 : 1 - bending_share) * *options.tolerance_mm};
  if (!options.draft_deg) return simplest;
  simplest.max_slope = front_share * slope_at_draft(*options.draft_deg);
  simplest.tolerance_mm -= std::min(.1 * simplest.tolerance_mm, most_held_mm);
  return simplest;
}

}  // namespace relievo
