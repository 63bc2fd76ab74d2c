#include "pipeline/body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "relievo/core/text.h"
#include "relievo/make_relief.h"
#include "relievo/plate/draft_in_file.h"
#include "relievo/plate/outline.h"
#include "relievo/relief/draft.h"
#include "relievo/scan/surface.h"

namespace relievo {
namespace {

// Shares of the tolerance that are reserved for other steps: bending triangles to a curved base, each of the two steps
// that bend them for a wrap, and flipping edges of thin triangles.
constexpr double base_share = .25, wrap_share = .2, turning_share = .01;
// The tolerance if only the number of triangles is limited; it is about the precision of files.
constexpr double least_error_mm = 1e-4;
// The width of the bevel as a share of the rim's height. The bevel is 17 degrees off the vertical, so that a
// die can be pulled off.
constexpr double rim_bevel = .3;

// The limit for the slopes of simplified fronts, as a share of the largest allowed slope. It exceeds the
// share of limit_draft(), 0.999, so that simplification has some freedom. It is below 1 because of rounding.
constexpr double front_share = .9995;
constexpr double ornament_share = .997;  // the same limit for walls of ornaments, whose corners are rounded
constexpr double most_held_mm = 1e-5;    // default limit for moves of points by enforce_draft_in_float()
constexpr double rounded_up = 1.002;  // largest factor by which the polygon of a curved rim steepens bevels

// Returns the share of the tolerance for one step that bends triangles.
double bending_share(const ReliefOptions& options) {
  return options.wrap.kind == WrapKind::none ? base_share : wrap_share;
}

// Returns the share of the tolerance that simplification may use.
double simplification_share(const ReliefOptions& options) {
  if (!is_curved(options)) return 1 - turning_share;
  return options.wrap.kind == WrapKind::none ? 1 - base_share : 1 - 2 * wrap_share;
}

// Returns the least width of a bevel of this height whose angle to the vertical is at least `draft_deg`.
double least_bevel(double height_mm, double draft_deg) {
  return rounded_up * height_mm / slope_at_draft(draft_deg);
}

// Returns the base for the form in the options. A mirrored form mirrors the base. A die turns a raised base
// into a hollow one, and a hollow one into a raised one.
BaseOptions formed_base(const ReliefOptions& options) {
  BaseOptions base = options.base;
  base.is_mirrored = is_mirrored(options.form);
  base.is_hollow ^= options.form == Form::die;
  return base;
}

// Returns the rim for the form in the options. The default bevel keeps the draft angle unless the rim is too
// narrow.
RimOptions formed_rim(const ReliefOptions& options, double relief_mm) {
  if (!options.rim_mm) return {};
  const double lean = options.draft_deg ? std::max(rim_bevel, least_bevel(1, *options.draft_deg)) : rim_bevel;
  const double width = *options.rim_mm;
  const double most = width / lean;  // height at which the default bevel is as wide as the rim
  const double usual_height = options.rim_bevel_mm ? relief_mm : std::min(most, relief_mm);
  const double height = options.rim_height_mm.value_or(usual_height);
  const double usual_bevel = height < most ? lean * height : width;
  const double bevel = std::min(width, options.rim_bevel_mm.value_or(usual_bevel));
  return {width, options.form == Form::die ? -height : height, bevel};
}

// Returns the convex hull of a relief, scaled to a longer side of 1.
std::vector<Vec2> unit_hull(const Surface& surface) {
  const double longer_side = surface.longer_side();
  std::vector<Vec2> hull;
  for (const Index i : surface.triangulation.hull)
    hull.emplace_back(surface.points[i].head<2>() / longer_side);
  return hull;
}

// Returns the largest width of a relief that leaves space for margin and rim on all sides of the plate. The
// centre of the relief's hull is that of the plate's outline, so each side of the outline limits the scale
// independently.
double largest_width_mm(const Surface& surface, const ReliefOptions& options) {
  const double edge_mm = options.effective_margin_mm() + options.rim_mm.value_or(0);
  const std::vector<Vec2> hull = unit_hull(surface);
  const std::vector<Vec2> outline =
      outline_around(hull, {options.outline, options.corner_mm, edge_mm, plate_size_of(options)});
  const Vec2 middle = Box::of(outline).centre().head<2>();
  double width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 along = outline[(i + 1) % outline.size()] - outline[i];
    const Vec2 normal = Vec2(along.y(), -along.x()).normalized();
    double farthest = 0;
    for (const Vec2& p : hull) farthest = std::max(farthest, (p - middle).dot(normal));
    const double room_mm = (outline[i] - middle - options.shift_mm).dot(normal) - edge_mm;
    if (farthest > 0) width = std::min(width, room_mm / farthest);
  }
  return width;
}

// Returns the names of the options that reduce the space for a relief on its plate, for errors.
std::string takers_of_room(const ReliefOptions& options) {
  const std::string_view last = options.shift_mm.isZero() ? "" : " and shift";
  if (!options.rim_mm) return cat("margin", last);
  return cat("margin", last.empty() ? " and rim" : ", rim", last);
}

// Returns an error if the options name a font or ornament file whose contents were not read. No default
// replaces such a file.
Result<void> check_files(const ReliefOptions& options) {
  if (!options.font_name.empty() && !options.font)
    return option_error("font", cat("expected the bytes of '", options.font_name, "', found none"));
  if (!options.ornament_source.empty() && options.ornaments.empty())
    return option_error("ornaments", cat("expected those of '", options.ornament_source, "', found none"));
  return {};
}

}  // namespace

bool is_mirrored(Form form) {
  return form == Form::mirror || form == Form::die;
}

// Returns an error if the rim's bevel is closer to the vertical than the draft angle allows.
Result<void> check_rim(const ReliefOptions& options, double height_mm) {
  if (!options.draft_deg || !options.rim_mm) return {};
  const RimOptions rim = formed_rim(options, height_mm);
  const double least = least_bevel(std::abs(rim.height_mm), *options.draft_deg);
  if (rim.bevel_mm >= .9999 * least) return {};
  return option_error(options.rim_bevel_mm ? "rim-bevel" : "rim",
                      cat("expected at least ", least, " mm, so that the rim of ", std::abs(rim.height_mm),
                          " mm leans as draft asks, found ", rim.bevel_mm, " mm"));
}

bool is_simplified_as_plate(const ReliefOptions& options) {
  const bool is_made_whole = is_curved(options) || options.finish == Finish::reachable;
  return is_simplified(options) && is_made_whole && options.outline != Outline::none;
}

SimplifyOptions simplest_front(const ReliefOptions& options) {
  SimplifyOptions simplest{simplification_share(options) * options.tolerance_mm.value_or(least_error_mm)};
  if (options.triangles) simplest.most_triangles = static_cast<std::size_t>(*options.triangles);
  if (!options.draft_deg) return simplest;
  simplest.max_slope = front_share * slope_at_draft(*options.draft_deg);
  simplest.tolerance_mm -= std::min(.1 * simplest.tolerance_mm, most_held_mm);
  return simplest;
}

Vec2 plate_size_of(const ReliefOptions& options) {
  if (options.diameter_mm) return Vec2::Constant(*options.diameter_mm);
  return options.plate_mm.value_or(Vec2::Zero());
}

PlateOptions plate_of(const ReliefOptions& options, double relief_mm) {
  PlateOptions plate{options.effective_margin_mm(),
                     options.effective_thickness_mm(),
                     options.outline,
                     options.corner_mm,
                     formed_rim(options, relief_mm),
                     formed_base(options),
                     options.wrap};
  plate.size_mm = plate_size_of(options);
  plate.shift_mm = options.shift_mm;
  if (is_mirrored(options.form)) plate.shift_mm.x() *= -1;
  plate.ornaments = options.all_ornaments();
  plate.is_mirrored = is_mirrored(options.form);
  plate.is_die = options.form == Form::die;
  if (options.draft_deg) plate.ornament_slope = ornament_share * slope_at_draft(*options.draft_deg);
  if (options.finish == Finish::reachable) plate.tool = options.tool;
  if (options.tolerance_mm)
    plate.tolerance_mm = std::max(1e-4, bending_share(options) * *options.tolerance_mm);
  if (!is_simplified_as_plate(options)) return plate;
  const SimplifyOptions simplest = simplest_front(options);
  plate.simplify_mm = simplest.tolerance_mm;
  plate.max_slope = simplest.max_slope;
  plate.most_triangles = simplest.most_triangles;
  return plate;
}

Result<Body> make_body(const HeightFieldMesh& front, double relief_mm, const ReliefOptions& options) {
  const PlateOptions plate = plate_of(options, relief_mm);
  RELIEVO_CHECK(check_rim(options, relief_mm));
  RELIEVO_CHECK(check_files(options));
  RELIEVO_TRY(Solid solid, make_plate(front, plate));
  if (options.draft_deg) {
    RELIEVO_TRY(const double moved_mm, enforce_draft_in_float(solid, slope_at_draft(*options.draft_deg)));
    solid.error_mm += moved_mm;
  }
  if (plate.wrap.kind == WrapKind::none) return Body{std::move(solid)};
  RELIEVO_TRY(const Wrap wrap, plate_wrap(solid, plate));
  RELIEVO_TRY(Solid bent, wrap_plate(solid, plate));
  return Body{std::move(bent), std::move(solid), wrap};
}

ReliefOptions with_height(const Surface& surface, ReliefOptions options) {
  if (!options.height_of_diagonal) return options;
  options.height_mm = *options.height_of_diagonal * surface.diagonal * mm_per_unit(surface, options);
  options.height_of_diagonal.reset();
  return options;
}

Result<ReliefOptions> with_width(const Surface& surface, const ReliefOptions& options) {
  ReliefOptions sized = options;
  if (plate_size_of(options).x() == 0) {
    sized.width_mm = options.effective_width_mm();
    return with_height(surface, std::move(sized));
  }
  const double largest = largest_width_mm(surface, options);
  sized.width_mm = options.width_mm.value_or(largest);
  constexpr double rounding = 1 + 1e-6;  // tolerance for a width copied from a report, which is rounded
  if (*sized.width_mm > 0 && *sized.width_mm <= largest * rounding)
    return with_height(surface, std::move(sized));
  return option_error("width", cat("expected at most ", std::max(0.0, largest),
                                   " mm, which the plate leaves with its ", takers_of_room(options),
                                   options.width_mm ? cat(", found ", *options.width_mm, " mm") : ""));
}

}  // namespace relievo
