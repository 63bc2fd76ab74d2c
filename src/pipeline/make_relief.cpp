#include "relievo/make_relief.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/angle.h"
#include "pipeline/body.h"
#include "relievo/core/text.h"
#include "relievo/core/within_memory.h"
#include "relievo/job.h"
#include "relievo/plate/draft_in_file.h"
#include "relievo/relief/draft.h"
#include "relievo/relief/relief.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scan/surface.h"
#include "relievo/scene.h"
#include "scan/measured_cloud.h"

namespace relievo {
namespace {

// The results of all stages of a relief, and its options, for the report.
struct ReliefFacts {
  const Surface& surface;
  const Relief& relief;
  const FormedFront& formed;
  const Body& body;
  const ReliefOptions& options;
};

void report_shape(const Shape& shape, const ReliefOptions& options, ReliefReport& report) {
  const Compression& compression = shape.compression;
  // A given alpha is reported unchanged, because computing it from u would cause a rounding error.
  const bool is_given = !options.effective_height_mm() && compression.beta > 0;
  report.method = options.effective_method();
  report.alpha = is_given ? options.effective_alpha() : compression.alpha();
  if (compression.curve) report.alpha = std::numeric_limits<double>::quiet_NaN();
  report.beta = compression.beta;
  report.gamma = shape.gamma;
  report.u = compression.u;
  report.steps = shape.steps;
  report.has_needed_steps = shape.steps > options.steps;
  report.height_requested_mm = options.height_mm;
  if (!options.height_mm) report.height_usual_mm = options.effective_height_mm();
  report.idle_options = idle_options(options);
}

// Reports the heights of the front that the tool cuts. They differ from the heights of the relief, because
// the tool leaves material in narrow and deep places.
void report_reachable_heights(const Solid& plate, ReliefReport& report) {
  double lowest = plate.ground_mm, highest = lowest;
  for (std::size_t t = 0; t < plate.front_triangles; ++t)
    for (const Index i : plate.triangles[t]) {
      if (plate.regions[t] == Region::bevel) continue;
      lowest = std::min(lowest, plate.points[i].z());
      highest = std::max(highest, plate.points[i].z());
    }
  report.height_mm = highest - lowest;
  report.below_ground_mm = plate.ground_mm - lowest;
}

void report_body(const Body& body, const FormedFront& formed, const ReliefOptions& options,
                 ReliefReport& report) {
  const Solid& plate = body.plate();
  report.form = options.form;
  report.height_mm = formed.height_mm;
  report.below_ground_mm = depth_below_ground(formed.front);
  if (options.finish == Finish::reachable) report_reachable_heights(plate, report);
  report.steepest_deg = std::atan(steepest_slope(plate)) * 180 / std::numbers::pi;
  report.front_triangles = plate.front_triangles;
  report.full_triangles = formed.full_triangles;
  if (is_simplified(options))
    report.simplification_error_mm = formed.simplification_error_mm + body.solid.error_mm;
  report.tool = options.tool;
  if (options.tool) report.reach = measure_reach(plate, *options.tool);
  report.ornaments = plate.ornaments;
  if (options.rim_mm) report.rim_height_mm = std::abs(plate_of(options, formed.height_mm).rim.height_mm);
  if (body.wrap)
    report.wrap = {body.wrap->diameter_mm(), body.wrap->turn_deg(), body.wrap->mm_per_degree(),
                   body.wrap->is_inside(), body.wrap->across()};
}

// Sets the transform from the scan to the plate.
void report_place(const ReliefFacts& facts, ReliefReport& report) {
  const Form form = facts.options.form;
  const Vec3 sign(is_mirrored(form) ? -1 : 1, 1, form == Form::die ? -1 : 1);
  report.scale = mm_per_unit(facts.surface, facts.options);
  report.rotation = sign.asDiagonal() * facts.surface.view.R_view_model;
  const double lowest = Box::of(facts.surface.points).min.z();
  const Vec3 ground(0, 0, facts.formed.front.ground_mm - report.scale * sign.z() * lowest);
  report.offset = facts.body.plate().shift + ground - report.scale * report.rotation * facts.surface.centre;
}

ReliefReport report_on(const ReliefFacts& facts) {
  ReliefReport report;
  static_cast<ScanReport&>(report) = ScanReport::of(facts.surface);
  report_shape(facts.relief.shape, facts.options, report);
  report_body(facts.body, facts.formed, facts.options, report);
  report_place(facts, report);
  return report;
}

// Returns the heights of the base under the surface's points, in the surface's units; empty if the base is a
// plane.
Result<std::vector<double>> base_heights(const Surface& surface, const ReliefOptions& options,
                                         double mm_per_unit) {
  if (options.base.kind == BaseKind::plane) return std::vector<double>();
  HeightFieldMesh front = front_in_mm(surface, std::vector<double>(surface.points.size(), 0), mm_per_unit);
  if (options.outline == Outline::none) front.is_relief = surface.boundary.is_inside;
  RELIEVO_TRY(std::vector<double> heights, base_heights_mm(front, options));
  for (double& z : heights) z /= mm_per_unit;
  return heights;
}

// Makes the relief with the height that follows from its shape. Errors: kind geometry if that height is 0.
Result<Relief> make_free(const ReliefModel& model, const Shape& shape) {
  Relief relief = model.make(shape);
  const double least = 1e-6 * model.surface().longer_side();
  if (relief.height > least) return relief;
  return geometry_error(
      "expected a shape that gives the relief a height, found 0 mm in this view: ask for a height, "
      "which the steps between level parts can take");
}

// Returns the shape with the coefficient u of (6) infinite, which leaves heights uncompressed.
Shape uncompressed(Shape shape) {
  shape.compression.u = std::numeric_limits<double>::infinity();
  return shape;
}

// Makes the relief with the height in the options or, if they have none, with the height that follows from
// the shape.
Result<Relief> shape_relief(const ReliefModel& model, const ReliefOptions& options, const Shape& shape,
                            Progress* progress) {
  // A lithophane needs no search, because its height is exact by construction.
  if (options.form == Form::lithophane) return model.make(shape);
  if (options.mm_per_value)
    return relief_of_values(model.surface(), options, mm_per_unit(model.surface(), options));
  const double scale = mm_per_unit(model.surface(), options), height = options.height_mm.value_or(0) / scale;
  const Method method = options.effective_method();
  if (!options.draft_deg) {
    if (!options.height_mm) return make_free(model, shape);
    return make_by_method(method, model, height, shape, scale, progress);
  }
  RELIEVO_TRY(const std::vector<double> base, base_heights(model.surface(), options, scale));
  const DraftOptions draft{slope_at_draft(*options.draft_deg), base};
  if (!options.height_mm) {
    RELIEVO_TRY(Relief relief, make_free(model, shape));
    return limit_draft(model, std::move(relief), draft, progress);
  }
  return make_with_draft(model, {method, shape, height, scale}, draft, progress);
}

// Makes the relief with the requested or the default height. If the model is too shallow in this view for the
// default height, its slopes are not compressed, and the height follows from them. A requested height that is
// too large is an error.
Result<Relief> relief_of_height(const ReliefModel& model, ReliefOptions options, Progress* progress) {
  const double scale = mm_per_unit(model.surface(), options);
  const bool is_usual = !options.height_mm && options.effective_height_mm();
  options.height_mm = options.effective_height_mm();
  Result<Relief> relief = shape_relief(model, options, shape_of(options, scale), progress);
  const bool is_too_high = !relief && relief.error().kind == ErrorKind::geometry;
  if (!is_usual || !is_too_high || !has_shape(options.effective_method())) return relief;
  options.method = options.effective_method();
  options.height_mm.reset();
  Result<Relief> highest = shape_relief(model, options, uncompressed(shape_of(options, scale)), progress);
  return highest ? std::move(highest) : std::move(relief);
}

// Returns the result of relief_of_height(). If the height is a share of the diagonal and cannot be reached,
// the error also states the share that is reached with uncompressed slopes.
Result<Relief> relief_of(const ReliefModel& model, const ReliefOptions& options, bool is_share,
                         Progress* progress) {
  Result<Relief> relief = relief_of_height(model, options, progress);
  if (relief || relief.error().kind != ErrorKind::geometry || !is_share) return relief;
  if (!has_shape(options.effective_method())) return relief;
  const Shape shape = shape_of(options, mm_per_unit(model.surface(), options));
  const double highest = model.make(uncompressed(shape)).height;
  relief.error().expected +=
      cat("; normals alone reach ", highest / model.surface().diagonal, " of the diagonal");
  return relief;
}

// Returns the number of points and the requested resolution, from which the memory for a body is estimated.
MemoryNeed need_of(const ReliefModel& model, const ReliefOptions& options) {
  return {model.surface().points.size(), options.resolution_mm.value_or(0)};
}

// A relief, and the options with which it was made, including its width.
struct SizedRelief {
  ReliefOptions options;
  Relief relief;
};

Result<SizedRelief> find_relief(const ReliefModel& model, const ReliefOptions& asked, Progress* progress) {
  RELIEVO_CHECK(check_model(model, asked));
  RELIEVO_TRY(ReliefOptions options, with_width(model.surface(), asked));
  RELIEVO_CHECK(begin_stage(progress, "relief", .85));
  RELIEVO_TRY(Relief relief, relief_of(model, options, asked.height_of_diagonal.has_value(), progress));
  return SizedRelief{std::move(options), std::move(relief)};
}

Result<MadeRelief> make_solid(const Surface& surface, const SizedRelief& sized, Progress* progress) {
  const auto& [options, relief] = sized;
  RELIEVO_CHECK(begin_stage(progress, "solid", .9));
  RELIEVO_TRY(FormedFront full, full_front(surface, relief, options, progress));
  RELIEVO_CHECK(begin_stage(progress, "solid", .95));
  RELIEVO_TRY(FormedBody made, make_formed_body(std::move(full), options, progress));
  auto& [formed, body] = made;
  ReliefReport report = report_on({surface, relief, formed, body, options});
  return MadeRelief{std::move(body.solid), std::move(report), std::move(body.flat)};
}

}  // namespace

ScanReport ScanReport::of(const Surface& surface) {
  ScanReport report;
  report.input_points = surface.input_points;
  report.repeated_points = surface.repeated_points;
  report.visible_points = surface.visible_points;
  report.removed_points = surface.removed_points;
  report.crumbs = surface.crumbs;
  report.measured_noise = surface.measured_noise;
  report.removed_noise = surface.removed_noise;
  report.rho = surface.rho;
  report.diagonal = surface.diagonal;
  const bool has_plane = surface.view.has_plane;
  if (surface.plane) report.plane = {surface.plane->kind, surface.plane->share, !has_plane};
  report.lacks_plane = !surface.plane && !has_plane;
  report.has_estimated_normals = surface.has_estimated_normals;
  report.has_turned_normals = surface.has_flipped_normals;
  return report;
}

Shape shape_of(const ReliefOptions& options, double mm_per_unit) {
  Shape shape{Compression::from_alpha(options.effective_alpha(), options.effective_saturation()),
              options.effective_detail()};
  shape.style = default_shape(options.effective_method()).style;
  shape.is_beta_free = options.effective_method() == Method::paper && !options.saturation;
  if (options.steepest_deg) shape.max_slope = std::tan(to_radians(*options.steepest_deg));
  shape.boundary_width = options.effective_boundary_width();
  shape.steps = options.steps;
  shape.planes = options.effective_planes();
  if (options.tone) shape.compression.curve = std::make_shared<const ToneCurve>(*options.tone);
  if (options.light) shape.light = ReliefLight{*options.light, options.light_contrast};
  shape.attention = options.attention;
  shape.line_depth = options.colour_mm / mm_per_unit;
  if (!options.strokes.empty()) shape.strokes.list = std::make_shared<const Strokes>(options.strokes);
  return shape;
}

double mm_per_unit(const Surface& surface, const ReliefOptions& options) {
  return options.effective_width_mm() / surface.longer_side();
}

Result<ReliefModel> prepare(const Cloud& points, const View& view, const ModelOptions& options,
                            Progress* progress) {
  const std::shared_ptr<const Cloud> not_owned(std::shared_ptr<void>(), &points);
  return prepare_owned(not_owned, view, options, progress);
}

Result<ReliefModel> prepare_owned(std::shared_ptr<const Cloud> points, const View& view,
                                  const ModelOptions& options, Progress* progress) {
  return within_memory({.points = points->size()}, [&]() -> Result<ReliefModel> {
    RELIEVO_TRY(auto measured, MeasuredCloud::measure(*points, view, progress));
    points.reset();
    if (view.is_paper) return ReliefModel::of_view(*measured, view, options, progress);
    RELIEVO_TRY(Surface surface, find_surface(std::move(measured), view, progress));
    return ReliefModel::prepare(std::move(surface), progress, options);
  });
}

Result<double> highest_with_draft(const ReliefModel& model, const ReliefOptions& asked, Progress* progress) {
  return within_memory(need_of(model, asked), [&]() -> Result<double> {
    RELIEVO_CHECK(check(asked));
    RELIEVO_CHECK(check_model(model, asked));
    RELIEVO_TRY(ReliefOptions options, with_width(model.surface(), asked));
    options.height_mm.reset();
    const double scale = mm_per_unit(model.surface(), options);
    RELIEVO_TRY(const Relief relief,
                shape_relief(model, options, uncompressed(shape_of(options, scale)), progress));
    return relief.height * scale;
  });
}

Result<void> check_model(const ReliefModel& model, const ReliefOptions& options) {
  const Method method = options.effective_method();
  if (options.colour_mm > 0 && model.surface().colours.empty())
    return option_error("colour", "expected a scan with colours, found one without");
  for (const auto& [name, is_used] :
       {std::pair("light", options.light.has_value()), std::pair("attention", options.attention > 0)})
    if (is_used && model.subspace())
      return option_error(name, "expected mode exact with it, found a model of control points");
  const auto protects = [](const Stroke& stroke) { return stroke.brush == Brush::protect; };
  const auto is_own = [](float height) { return height > 0; };
  if (std::ranges::any_of(model.surface().own_heights, is_own) &&
      std::ranges::any_of(options.strokes, protects))
    return option_error("strokes", "expected no brush protect, as a model of the scene has its own height");
  if (model.serves(method)) return {};
  return option_error("method",
                      cat("expected ", model.paper() ? "paper" : cat("another than ", name_of(method)),
                          ", as the model was prepared for that; prepare it again with this method"));
}

Result<MadeRelief> make_relief(const ReliefModel& model, const ReliefOptions& options, Progress* progress) {
  return within_memory(need_of(model, options), [&]() -> Result<MadeRelief> {
    RELIEVO_CHECK(check(options));
    RELIEVO_TRY(const SizedRelief sized, find_relief(model, options, progress));
    return make_solid(model.surface(), sized, progress);
  });
}

Result<MadeRelief> make_relief(Scene scene, const ReliefOptions& options, Progress* progress) {
  RELIEVO_CHECK(check(options));
  RELIEVO_TRY(SampledModel prepared, prepare_sampled(Job{std::move(scene), options}, progress));
  return within_memory(need_of(prepared.model, options), [&]() -> Result<MadeRelief> {
    RELIEVO_TRY(const SizedRelief sized, find_relief(prepared.model, options, progress));
    const Surface surface = std::move(prepared.model).take_surface();  // frees the solver's memory
    RELIEVO_TRY(MadeRelief made, make_solid(surface, sized, progress));
    made.report.sample = std::move(prepared.notes);
    return made;
  });
}

Result<MadeRelief> make_relief(CloudFile file, const ReliefOptions& options, Progress* progress) {
  return within_memory([&] {
    Scene scene{{{{}, std::make_shared<const CloudFile>(std::move(file))}}};
    return make_relief(std::move(scene), options, progress);
  });
}

Result<MadeRelief> make_relief(Cloud cloud, const ReliefOptions& options, Progress* progress) {
  return make_relief(CloudFile{std::move(cloud), {}}, options, progress);
}

}  // namespace relievo
