#include "relievo/make_relief.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "plate_of.h"
#include "relievo/core/text.h"
#include "relievo/mesh.h"
#include "relievo/method.h"
#include "relievo/plate/forms.h"
#include "relievo/relief/draft.h"
#include "relievo/simplify.h"
#include "relievo/view.h"
#include "silhouette.h"

namespace relievo {
namespace {

Box visible_box(const Surface& surface) {
  Box box;
  for (const Vec3& p : surface.points) box.extend(p);
  return box;
}

Front front_in_mm(const Surface& surface, const Relief& relief, double mm_per_unit) {
  Front front{std::vector<Vec3>(surface.points.size()), surface.triangulation.triangles,
              surface.triangulation.hull};
  for (std::size_t i = 0; i < front.points.size(); ++i) {
    const Vec3& p = surface.points[i];
    front.points[i] = mm_per_unit * Vec3(p.x(), p.y(), relief.heights[i]);
  }
  front.colours = surface.colours;
  return front;
}

// Heights of the base under the surface's points, in its units; none for a plane.
Result<std::vector<double>> base_heights(const Surface& surface, const ReliefOptions& options,
                                         double mm_per_unit) {
  const PlateOptions plate = plate_of(options, Form::relief, 1);
  if (plate.base.kind == BaseKind::plane) return std::vector<double>();
  const Relief flat{std::vector<double>(surface.points.size(), 0), 0, {}};
  Front front = front_in_mm(surface, flat, mm_per_unit);
  if (plate.outline == Outline::none) front.is_relief = surface.boundary.is_inside;
  const Result<Base> base = plate_base(front, plate);
  if (!base) return std::unexpected(base.error());
  std::vector<double> heights;
  for (const Vec3& p : front.points) heights.push_back(base->height(p.head<2>()) / mm_per_unit);
  return heights;
}

Result<Relief> shape_relief(const ReliefModel& model, const ReliefOptions& options, double mm_per_unit,
                            Progress* progress) {
  const Result<Shape> shape = shape_of(options);
  if (!shape) return std::unexpected(shape.error());
  const Method method = *parse_method(options.effective_method());
  const double height = options.height_mm.value_or(0) / mm_per_unit;
  if (!options.draft_deg) {
    if (!options.height_mm) return model.make(*shape);
    return make_by_method(method, model, height, *shape, mm_per_unit, progress);
  }
  const Result<std::vector<double>> base = base_heights(model.surface(), options, mm_per_unit);
  if (!base) return std::unexpected(base.error());
  const DraftOptions draft{slope_at_draft(*options.draft_deg), *base};
  if (!options.height_mm) return limit_draft(model, model.make(*shape), draft, progress);
  return make_with_draft(model, {method, *shape, height, mm_per_unit}, draft, progress);
}

ReliefReport report_on(const Surface& surface, const Relief& relief, const ReliefOptions& options) {
  ReliefReport report;
  report.input_points = surface.input_points;
  report.visible_points = surface.visible_points;
  report.rho = surface.rho;
  report.diagonal = surface.diagonal;
  const Compression& compression = relief.shape.compression;
  // As given, where it was given: from u it comes back with a rounding error.
  const bool is_given = !options.height_mm && compression.beta > 0;
  report.alpha = is_given ? options.effective_alpha() : compression.alpha();
  if (compression.curve) report.alpha = std::numeric_limits<double>::quiet_NaN();
  report.beta = compression.beta;
  report.u = compression.u;
  report.gamma = relief.shape.gamma;
  report.method = options.effective_method();
  report.height_requested_mm = options.height_mm;
  if (options.alpha && compression.beta == 0)
    report.remarks.push_back("alpha has no effect at saturation 0; a height sets how flat the relief is");
  if (surface.has_estimated_normals)
    report.remarks.push_back("the input has no normals: they were estimated");
  if (surface.has_flipped_normals)
    report.remarks.push_back("the input's normals point inwards: they were turned");
  return report;
}

// Lowest and highest point of the front, ground included.
std::pair<double, double> span_of(const Front& front) {
  double lowest = front.ground_mm, highest = lowest;
  for (const Vec3& p : front.points) lowest = std::min(lowest, p.z()), highest = std::max(highest, p.z());
  return {lowest, highest};
}

double height_of(const Front& front) {
  const auto [lowest, highest] = span_of(front);
  return highest - lowest;
}

// How far the lowest point of the front lies below the ground: 0 or more.
double depth_below_ground(const Front& front) {
  return front.ground_mm - span_of(front).first;
}

constexpr double default_lithophane_mm = 2.4;  // height where none is asked for

// A lithophane has no height to reach: its own is exact by construction.
Result<Relief> relief_for(Form form, const ReliefModel& model, ReliefOptions options, double mm_per_unit,
                          Progress* progress) {
  if (form == Form::lithophane) options.height_mm.reset();
  return shape_relief(model, options, mm_per_unit, progress);
}

// The front in the form asked for, and as simple as allowed.
Result<Front> formed_front(Form form, const Surface& surface, const Relief& relief,
                           const ReliefOptions& options, ReliefReport& report, Progress* progress) {
  const double scale = mm_per_unit(surface, options);
  const double lithophane_mm = options.height_mm.value_or(default_lithophane_mm);
  Front front = form == Form::lithophane ? lithophane(surface, scale, lithophane_mm)
                                         : front_in_mm(surface, relief, scale);
  report.height_mm = form == Form::lithophane ? lithophane_mm : relief.height * scale;
  if (*parse_outline(options.outline) == Outline::none) front.is_relief = surface.boundary.is_inside;
  if (form == Form::mirror) front = mirrored(std::move(front));
  if (form == Form::die) front = as_die(std::move(front));
  if (options.surface == "reachable") {
    Result<Front> reachable = reachable_front(front, *parse_tool(options.tool));
    if (!reachable) return reachable;
    front = std::move(*reachable);
    report.height_mm = height_of(front);  // what is narrow and deep is filled
  }
  if (!options.tolerance_mm || plate_of(options, form, 1).simplify_mm > 0) return front;
  Result<SimplerFront> simpler = simplify(front, simplest_front(options), progress);
  if (!simpler) return std::unexpected(simpler.error());
  report.simplification_error_mm = simpler->error_mm;
  return std::move(simpler->front);
}

// The formed front, or what of it is relief where no ground is wanted.
Result<Front> front_for(Form form, const Surface& surface, const Relief& relief, const ReliefOptions& options,
                        ReliefReport& report, Progress* progress) {
  Result<Front> front = formed_front(form, surface, relief, options, report, progress);
  if (front && !front->is_relief.empty()) return relief_alone(*front);
  return front;
}

void add_reach(MadeRelief& made, const ReliefOptions& options) {
  const ToolReach& reach = made.report.reach.emplace(measure_reach(made.solid, *parse_tool(options.tool)));
  made.report.remarks.push_back(cat("the tool ", text_of(*parse_tool(options.tool)), " reaches ",
                                    100 * reach.reached_share, " % of the front within ", reach.tolerance_mm,
                                    " mm and leaves at most ", reach.largest_residual_mm,
                                    " mm (sampled every ", reach.mm_per_sample, " mm)"));
}

// A bevel of its own is asked for by the user: it must lean as walls must.
Result<void> check_bevel(const RimOptions& rim, const ReliefOptions& options) {
  if (!options.draft_deg || !options.rim_mm) return {};
  const double least = least_bevel(std::abs(rim.height_mm), *options.draft_deg);
  if (rim.bevel_mm >= .9999 * least) return {};
  return std::unexpected(
      Error{ErrorKind::option,
            options.rim_bevel_mm ? "--rim-bevel" : "--rim",
            {},
            cat("expected at least ", least, " mm, so that the rim of ", std::abs(rim.height_mm),
                " mm leans as --draft asks, found ", rim.bevel_mm, " mm")});
}

// Tells how far the front is off, its plate's part included.
void tell_simplification(ReliefReport& report, const Solid& solid, std::size_t full_triangles) {
  report.simplification_error_mm = report.simplification_error_mm.value_or(0) + solid.error_mm;
  report.remarks.push_back(cat("the front has ", solid.front_triangles, " triangles, the full relief ",
                               full_triangles, ", and is off by at most ", *report.simplification_error_mm,
                               " mm"));
}

// Bends the solid and keeps the flat one.
Result<MadeRelief> wrapped(MadeRelief made, const PlateOptions& plate) {
  const Result<Wrap> wrap = plate_wrap(made.solid, plate);
  if (!wrap) return std::unexpected(wrap.error());
  Result<Solid> bent = wrap_plate(made.solid, plate);
  if (!bent) return std::unexpected(bent.error());
  made.flat = std::exchange(made.solid, std::move(*bent));
  made.report.wrap = {wrap->diameter_mm(), wrap->turn_deg(), wrap->mm_per_degree()};
  made.report.remarks.push_back(cat("the ground has a diameter of ", wrap->diameter_mm(),
                                    " mm, goes around by ", wrap->turn_deg(), " degrees and has ",
                                    wrap->mm_per_degree(), " mm in a degree"));
  return made;
}

// Tells where the scan lies, when the plate's making moved the front by `shift`.
void place(ReliefReport& report, const Surface& surface, const Front& front, const Vec3& shift, Form form) {
  const Box box = visible_box(surface);
  const Vec3 sign(is_mirrored(form) ? -1 : 1, 1, form == Form::die ? -1 : 1);
  report.rotation = sign.asDiagonal() * surface.view.rotation;
  const Vec3 ground(0, 0, front.ground_mm - report.scale * sign.z() * box.min.z());
  report.offset = shift + ground - report.scale * report.rotation * surface.centre;
}

}  // namespace

Result<Shape> shape_of(const ReliefOptions& options) {
  const double beta = options.effective_saturation();
  Shape shape{Compression::from_alpha(options.effective_alpha(), beta), options.effective_detail()};
  if (const auto method = parse_method(options.effective_method()))
    shape.style = default_shape(*method).style;
  if (options.steepest_deg) shape.max_slope = std::tan(*options.steepest_deg * std::numbers::pi / 180);
  shape.boundary_width = options.effective_boundary_width();
  if (options.tone.empty()) return shape;
  Result<ToneCurve> curve = parse_tone_curve(options.tone);
  if (!curve) return std::unexpected(curve.error());
  shape.compression.curve = std::make_shared<const ToneCurve>(std::move(*curve));
  return shape;
}

double mm_per_unit(const Surface& surface, const ReliefOptions& options) {
  const Vec3 size = visible_box(surface).size();
  return options.width_mm / std::max(size.x(), size.y());
}

Result<MadeRelief> make_relief(const ReliefModel& model, const ReliefOptions& options, Progress* progress) {
  if (auto ok = check(options); !ok) return std::unexpected(ok.error());
  const double scale = mm_per_unit(model.surface(), options);
  const Form form = *parse_form(options.form);
  if (auto go = begin_stage(progress, "relief", .85); !go) return std::unexpected(go.error());
  const Result<Relief> relief = relief_for(form, model, options, scale, progress);
  if (!relief) return std::unexpected(relief.error());

  if (auto go = begin_stage(progress, "solid", .95); !go) return std::unexpected(go.error());
  MadeRelief made;
  made.report = report_on(model.surface(), *relief, options);
  const Result<Front> front = front_for(form, model.surface(), *relief, options, made.report, progress);
  if (!front) return std::unexpected(front.error());
  const PlateOptions plate = plate_of(options, form, made.report.height_mm);
  if (auto ok = check_bevel(plate.rim, options); !ok) return std::unexpected(ok.error());
  Result<Solid> solid = make_plate(*front, plate);
  if (!solid) return std::unexpected(solid.error());
  if (options.draft_deg) {
    const Result<double> moved = hold_draft(*solid, slope_at_draft(*options.draft_deg));
    if (!moved) return std::unexpected(moved.error());
    solid->error_mm += *moved;
  }
  made.solid = std::move(*solid);
  made.report.steepest_deg = std::atan(steepest_slope(made.solid)) * 180 / std::numbers::pi;
  if (!options.tool.empty()) add_reach(made, options);
  made.report.below_ground_mm = depth_below_ground(*front);
  made.report.scale = scale;
  if (options.tolerance_mm)
    tell_simplification(made.report, made.solid, model.surface().triangulation.triangles.size());
  place(made.report, model.surface(), *front, made.solid.shift, form);
  if (plate.wrap.kind == WrapKind::none) return made;
  return wrapped(std::move(made), plate);
}

namespace {

// The cloud without its strays, which is not copied if there are none.
SeenPoints near_points(std::shared_ptr<const Cloud> cloud) {
  const std::vector<Index> strays = far_points(*cloud);
  if (strays.empty()) return {std::move(cloud), 0, {}};
  return {std::make_shared<const Cloud>(without(*cloud, strays)),
          strays.size(),
          {cat("left out ", strays.size(), " points far from all others")}};
}

std::shared_ptr<const Cloud> not_owned(const Cloud& cloud) {
  return {std::shared_ptr<void>(), &cloud};
}

}  // namespace

Result<SeenPoints> seen_points(const CloudFile& file, const View& view, double points, Progress* progress) {
  if (file.mesh.empty()) return near_points(not_owned(file.cloud));
  Result<Cloud> sampled = sample_mesh(file.mesh, view, {points}, progress);
  if (!sampled) return std::unexpected(sampled.error());
  const std::size_t taken = sampled->size();
  SeenPoints seen = near_points(std::make_shared<const Cloud>(std::move(*sampled)));
  seen.remarks.push_back(
      cat("the mesh has ", file.mesh.triangles.size(), " triangles: ", taken, " points taken"));
  return seen;
}

Result<MadeRelief> make_relief(const SeenPoints& seen, const View& view, const ReliefOptions& options,
                               Progress* progress) {
  if (auto ok = check(options); !ok) return std::unexpected(ok.error());
  const Result<Mode> mode = parse_mode(options.mode);
  if (!mode) return std::unexpected(mode.error());
  Result<Surface> surface = find_surface(*seen.cloud, view, {}, progress);
  if (!surface) return std::unexpected(surface.error());
  const Result<ReliefModel> model = ReliefModel::prepare(std::move(*surface), progress, *mode);
  if (!model) return std::unexpected(model.error());
  Result<MadeRelief> made = make_relief(*model, options, progress);
  if (made) made->report.remarks.insert(made->report.remarks.end(), seen.remarks.begin(), seen.remarks.end());
  return made;
}

Result<MadeRelief> make_relief(const CloudFile& file, const ReliefOptions& options, Progress* progress) {
  if (auto ok = check(options); !ok) return std::unexpected(ok.error());
  const Result<View> view = parse_view(options.view, options.up);
  if (!view) return std::unexpected(view.error());
  const Result<SeenPoints> seen = seen_points(file, *view, options.points, progress);
  if (!seen) return std::unexpected(seen.error());
  return make_relief(*seen, *view, options, progress);
}

Result<MadeRelief> make_relief(const Cloud& cloud, const ReliefOptions& options, Progress* progress) {
  if (auto ok = check(options); !ok) return std::unexpected(ok.error());
  const Result<View> view = parse_view(options.view, options.up);
  if (!view) return std::unexpected(view.error());
  return make_relief(near_points(not_owned(cloud)), *view, options, progress);
}

}  // namespace relievo
