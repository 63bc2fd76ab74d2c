// The actions that concern the engine of a document, and what the page is told at its start.
#include <nlohmann/json.hpp>

#include "common/export_file.h"
#include "common/files.h"
#include "common/make_report.h"
#include "common/option_list.h"
#include "common/scene_file.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"
#include "relievo/io/read.h"
#include "relievo/samples/sample.h"
#include "studio/actions.h"
#include "studio/requests.h"

namespace relievo::app::studio {

using Json = nlohmann::json;

// Returns the models of a scene file and how each stands, as such a file has them; none for other scans.
static Json models_of(const ScanSource& input) {
  Json models = Json::array();
  if (!input.sample.empty() || ending_of(input.path) != "json") return models;
  const auto bytes = read_file(input.path);
  if (!bytes) return models;
  const auto entries = read_scene_file(text_in(*bytes), input.path);
  for (const auto& [path, pose] : entries.value_or(std::vector<SceneEntry>())) {
    const Vec3& turn = pose.rotate_deg;
    models.push_back({{"file", path},
                      {"rotate", {turn.x(), turn.y(), turn.z()}},
                      {"scale", pose.scale},
                      {"mirror", pose.is_mirrored}});
    if (const auto& move = pose.translate) models.back()["translate"] = {move->x(), move->y(), move->z()};
  }
  return models;
}

// Returns the engine of the document that the request names; otherwise answers that it is not open.
std::shared_ptr<Engine> Actions::engine_of(const Json& json, Answer& to) {
  auto engine = documents_.find(json.value("document", ""));
  if (!engine)
    answer(to, {{"error", {{"kind", "closed"}, {"text", "expected a document that is open"}}}}, 409);
  return engine;
}

void Actions::view(const Json& json, Answer& to) {
  const auto engine = engine_of(json, to);
  if (!engine) return;
  const auto ok = engine->choose_view(view_values(json));
  ok ? answer(to, Json::object()) : answer(to, ok.error());
}

void Actions::cancel(const Json& json, Answer& to) {
  const auto engine = engine_of(json, to);
  if (!engine) return;
  engine->cancel();
  answer(to, Json::object());
}

void Actions::facts(const Json& json, Answer& to) {
  const auto engine = engine_of(json, to);
  if (!engine) return;
  const Result<ModelFacts> facts = engine->facts();
  if (!facts) return answer(to, facts.error());
  Json told = to_json(*facts);
  told["models"] = models_of(engine->status().input);
  answer(to, told);
}

void Actions::views(const Json& json, Answer& to) {
  const auto engine = engine_of(json, to);
  if (!engine) return;
  const auto views = engine->suggest_views();
  if (!views) return answer(to, views.error());
  Json sides = Json::array();
  for (const ViewGuess& side : *views) sides.push_back({{"view", side.name}, {"up", side.up}});
  answer(to, {{"views", sides}});
}

void Actions::status(const Json& json, Answer& to) {
  const auto engine = engine_of(json, to);
  if (!engine) return;
  answer(to, status_of({json.value("document", ""), engine}));
}

void Actions::frame(const Json& json, Answer& to) {
  const Result<PictureRequest> request = picture_request(json);
  if (!request) return answer(to, request.error());
  const auto engine = engine_of(json, to);
  if (!engine) return;
  const Result<PictureAnswer> made = engine->picture(*request);
  if (!made) return answer(to, made.error());
  answer(to, made->picture, to_json(*made));
}

void Actions::scan(const Json& json, Answer& to) {
  const Result<View> view = view_from(json);
  const Result<PictureRequest> size = picture_request(json);
  if (!view || !size) return answer(to, view ? size.error() : view.error());
  const auto engine = engine_of(json, to);
  if (!engine) return;
  const Result<Picture> picture = engine->scan_picture(*view, size->render.width, size->render.height);
  if (!picture) return answer(to, picture.error());
  answer(to, *picture, {{"width", picture->image.width}, {"height", picture->image.height}});
}

void Actions::profile(const Json& json, Answer& to) {
  const Result<PictureRequest> request = picture_request(json);
  const Result<Vec2> from = place_from(json, "from"), until = place_from(json, "to");
  if (!request) return answer(to, request.error());
  if (!from || !until) return answer(to, from ? until.error() : from.error());
  const auto engine = engine_of(json, to);
  if (!engine) return;
  const auto heights = engine->profile(*request, {*from, *until});
  if (!heights) return answer(to, heights.error());
  answer(to, {{"heights_mm", *heights}});
}

void Actions::reach(const Json& json, Answer& to) {
  const Result<PictureRequest> request = picture_request(json);
  if (!request) return answer(to, request.error());
  const auto engine = engine_of(json, to);
  if (!engine) return;
  const Result<double> height = engine->reachable_height(*request);
  height ? answer(to, {{"height_mm", *height}}) : answer(to, height.error());
}

// Tells whether options can be read and do not contradict each other.
void Actions::check(const Json& json, Answer& to) {
  const Result<ReliefOptions> options = options_from_json(json.value("options", Json()), "options");
  if (!options) return answer(to, options.error());
  const Result<void> checked = relievo::check(*options);
  checked ? answer(to, Json::object()) : answer(to, checked.error());
}

// Makes the piece as export writes it, and tells how large it is.
void Actions::piece(const Json& json, Answer& to) {
  const Result<ReliefOptions> options = options_from_json(json.value("options", Json()), "options");
  if (!options) return answer(to, options.error());
  const auto engine = engine_of(json, to);
  if (!engine) return;
  const auto made = engine->piece(*options, json["options"].dump());
  if (!made) return answer(to, made.error());
  const Solid& solid = (*made)->solid;
  const Vec3 size = size_mm(solid);
  answer(to, {{"triangles", solid.triangles.size()},
              {"points", solid.points.size()},
              {"size_mm", {size.x(), size.y(), size.z()}},
              {"height_mm", relief_height_mm(**made, *options)}});
}

void Actions::cancel_piece(const Json& json, Answer& to) {
  const auto engine = engine_of(json, to);
  if (!engine) return;
  engine->cancel_making();
  answer(to, Json::object());
}

void Actions::make_file(const Json& json, Answer& to) {
  const Result<ReliefOptions> wanted = options_from_json(json.value("options", Json()), "options");
  if (!wanted) return answer(to, wanted.error());
  const Result<ExportOrder> order = export_order_from(json);
  if (!order) return answer(to, order.error());
  const auto engine = engine_of(json, to);
  if (!engine) return;
  Result<ExportedFile> file =
      engine->make_file({*wanted, json["options"].dump(), json.value("format", ""), *order});
  if (!file) return answer(to, file.error());
  to = {200, std::move(file->type), std::move(file->bytes)};
}

Json Actions::about() {
  Json samples = Json::array();
  for (const SampleInfo& sample : relievo::samples())
    samples.push_back({{"name", sample.name}, {"description", sample.description}});
  const Lock lock(storing_);
  return {{"version", version},
          {"options", option_list()},
          {"readable", readable_formats()},
          {"endings", readable_endings()},
          {"views", view_list()},
          {"materials", material_list()},
          {"stages", stage_list()},
          {"curve", {{"most_points", ToneCurve::most_points}}},
          {"formats", format_list()},
          {"samples", samples},
          {"recent", recent_list()},
          {"first", first_},
          {"notice", store_.notice()},
          {"most_upload", most_scan}};
}

}  // namespace relievo::app::studio
