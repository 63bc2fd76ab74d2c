// Makes the report on a relief, as JSON.
#include <cmath>
#include <nlohmann/json.hpp>

#include "common/make_order.h"
#include "common/wording.h"
#include "relievo/core/parallel.h"
#include "relievo/core/version.h"

namespace relievo::app {
namespace {

nlohmann::json wrap_json(const std::optional<ReliefReport::Wrapped>& wrap) {
  if (!wrap) return {};
  return {{"diameter_mm", wrap->diameter_mm},
          {"turn_degrees", wrap->turn_deg},
          {"mm_per_degree", wrap->mm_per_degree}};
}

nlohmann::json reach_json(const ReliefReport& report) {
  if (!report.reach) return {};
  return {{"reached_share", report.reach->reached_share},
          {"largest_residual_mm", report.reach->largest_residual_mm},
          {"tolerance_mm", report.reach->tolerance_mm},
          {"mm_per_sample", report.reach->mm_per_sample}};
}

nlohmann::json ornaments_json(const OrnamentFacts& facts) {
  if (facts.highest_mm == 0) return {};
  return {{"highest_mm", facts.highest_mm},
          {"thinnest_mm",
           std::isfinite(facts.thinnest_mm) ? nlohmann::json(facts.thinnest_mm) : nlohmann::json()}};
}

std::vector<double> row_by_row(const Mat3& m) {
  std::vector<double> values;
  for (int i = 0; i < 9; ++i) values.push_back(m(i / 3, i % 3));
  return values;
}

std::vector<double> as_list(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

nlohmann::json plane_json(const std::optional<ScanReport::FoundPlane>& plane) {
  if (!plane) return {};
  return {{"kind", name_in(plane_kinds, plane->kind)},
          {"share", plane->share},
          {"is_left_out", plane->is_left_out}};
}

nlohmann::json report_json(const ReliefReport& report, std::span<const StageTime> times) {
  const auto number_or_null = [](double x) {
    return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json();
  };
  nlohmann::json seconds = nlohmann::json::object();
  for (const StageTime& stage : times) seconds[stage.name] = seconds.value(stage.name, 0.0) + stage.seconds;
  return {
      {"version", version},
      {"threads", thread_count()},
      {"input_points", report.input_points},
      {"repeated_points", report.repeated_points},
      {"visible_points", report.visible_points},
      {"removed_points", report.removed_points},
      {"crumbs", report.crumbs},
      {"measured_noise", report.measured_noise},
      {"removed_noise", report.removed_noise},
      {"plane", plane_json(report.plane)},
      {"rho", report.rho},
      {"diagonal", report.diagonal},
      {"method", name_of(report.method)},
      {"alpha", number_or_null(report.alpha)},
      {"beta", report.beta},
      {"gamma", report.gamma},
      {"u", number_or_null(report.u)},
      {"steps", report.steps},
      {"height_requested_mm",
       report.height_requested_mm ? nlohmann::json(*report.height_requested_mm) : nlohmann::json()},
      {"height_usual_mm",
       report.height_usual_mm ? nlohmann::json(*report.height_usual_mm) : nlohmann::json()},
      {"height_mm", report.height_mm},
      {"below_ground_mm", report.below_ground_mm},
      {"steepest_deg", report.steepest_deg},
      {"tool", reach_json(report)},
      {"simplification_error_mm",
       report.simplification_error_mm ? nlohmann::json(*report.simplification_error_mm) : nlohmann::json()},
      {"wrap", wrap_json(report.wrap)},
      {"seconds", seconds},
      {"model_to_mm",
       {{"rotation", row_by_row(report.rotation)},
        {"scale", report.scale},
        {"offset", as_list(report.offset)}}},
      {"ornaments", ornaments_json(report.ornaments)},
      {"remarks", remarks_on(report)}};
}

}  // namespace

nlohmann::json models_report(const Scene& scene, const View& view) {
  const auto places = place_models(scene, view);
  nlohmann::json models = nlohmann::json::array();
  for (std::size_t i = 0; places && i < places->size(); ++i) {
    const CloudFile& file = *scene.models[i].file;
    const PlacedModel& place = (*places)[i];
    models.push_back({{"file", scene.models[i].name},
                      {"format", file.format},
                      {"points", file.cloud.size()},
                      {"triangles", file.mesh.triangles.size()},
                      {"model_to_scene",
                       {{"rotation", row_by_row(place.turn)},
                        {"scale", place.scale},
                        {"offset", as_list(place.offset)}}}});
  }
  return models;
}

nlohmann::json FinishedRelief::report(LengthUnit unit) const {
  nlohmann::json report = kept_report;
  if (report.is_null()) {
    report = report_json(made.report, times);
    report["size_mm"] = as_list(Box::of(made.solid.points).size());
    report["models"] = inputs.models;
  }
  report["units"] = name_of(unit);
  return report;
}

}  // namespace relievo::app
