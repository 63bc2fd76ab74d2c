#include "pipeline/report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "relievo/plate/draft_in_file.h"
#include "relievo/scan/surface.h"

namespace relievo {
namespace {

void report_shape(const Shape& shape, const ReliefOptions& options, ReliefReport& report) {
  const Compression& compression = shape.compression;
  // A given alpha is reported as it was given: computed from u it would have a rounding error.
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
  report.has_idle_alpha = options.alpha && compression.beta == 0;
}

// Fills in the heights of a front that a tool has changed; it leaves material in narrow, deep places.
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
    report.simplification_error_mm = formed.simplification_error_mm + plate.error_mm;
  report.tool = options.tool;
  if (options.tool) report.reach = measure_reach(plate, *options.tool);
  if (body.wrap)
    report.wrap = {body.wrap->diameter_mm(), body.wrap->turn_deg(), body.wrap->mm_per_degree(),
                   body.wrap->is_inside(), body.wrap->across()};
}

// Fills in the place of the scan in the plate.
void report_place(const ReliefFacts& facts, ReliefReport& report) {
  const Form form = facts.options.form;
  const Vec3 sign(is_mirrored(form) ? -1 : 1, 1, form == Form::die ? -1 : 1);
  report.scale = mm_per_unit(facts.surface, facts.options);
  report.rotation = sign.asDiagonal() * facts.surface.view.R_view_model;
  const double lowest = Box::of(facts.surface.points).min.z();
  const Vec3 ground(0, 0, facts.formed.front.ground_mm - report.scale * sign.z() * lowest);
  report.offset = facts.body.plate().shift + ground - report.scale * report.rotation * facts.surface.centre;
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

ReliefReport report_on(const ReliefFacts& facts) {
  ReliefReport report;
  static_cast<ScanReport&>(report) = ScanReport::of(facts.surface);
  report_shape(facts.relief.shape, facts.options, report);
  report_body(facts.body, facts.formed, facts.options, report);
  report_place(facts, report);
  return report;
}

}  // namespace relievo
