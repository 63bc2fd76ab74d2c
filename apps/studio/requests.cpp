#include "studio/requests.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "relievo/core/choice.h"
#include "relievo/core/text.h"
#include "studio/model_points.h"

namespace relievo::app::studio {
namespace {

using Json = nlohmann::json;

// Names of the materials for users, in the same order as material_choices.
constexpr std::array<std::string_view, material_choices.size()> material_names{
    "Plaster", "Struck silver", "Bronze", "Walnut", "Porcelain, lit from behind"};
constexpr double most_pixels = 8e6, most_fine_pixels = 2.5e6;

std::unexpected<Error> wrong(std::string field, std::string expected) {
  return std::unexpected(Error{ErrorKind::input, std::move(field), {}, std::move(expected)});
}

struct Range {
  double min, max, otherwise;
};

// Returns the number under `key`. Returns `range.otherwise` if the key is missing, and nothing if its value is not a
// number within the range.
std::optional<double> number(const Json& json, const char* key, const Range& range) {
  const auto found = json.find(key);
  if (found == json.end()) return range.otherwise;
  if (!found->is_number()) return std::nullopt;
  const double value = found->get<double>();
  if (!(value >= range.min && value <= range.max)) return std::nullopt;
  return value;
}

bool flag(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_boolean() && found->get<bool>();
}

template <int n>
std::optional<Eigen::Matrix<double, n, 1>> numbers(const Json& json, const char* key) {
  const auto found = json.find(key);
  const auto is_number = [](const Json& each) { return each.is_number(); };
  if (found == json.end() || !found->is_array() || found->size() != n) return std::nullopt;
  if (!std::ranges::all_of(*found, is_number)) return std::nullopt;
  const std::vector<double> all = found->get<std::vector<double>>();
  const Eigen::Matrix<double, n, 1> v(all.data());
  return v.allFinite() ? std::optional(v) : std::nullopt;
}

// Returns a direction, scaled so that its largest component is 1 or -1. Then its components can be converted to
// float, and squared, without overflow.
std::optional<Vec3> direction(const Json& json, const char* key) {
  const std::optional<Vec3> v = numbers<3>(json, key);
  if (!v || v->isZero(0)) return std::nullopt;
  return Vec3(*v / v->cwiseAbs().maxCoeff());
}

Result<Camera> camera_from(const Json& json) {
  if (!json.is_object()) return wrong("camera", "expected an object");
  Camera camera;
  for (const auto& [key, value] :
       {std::pair("yaw", &camera.yaw_deg), std::pair("pitch", &camera.pitch_deg),
        std::pair("zoom", &camera.zoom), std::pair("x", &camera.pan.x()), std::pair("y", &camera.pan.y())}) {
    const Json number = json.value(key, Json(*value));
    if (!number.is_number()) return wrong(key, "expected a number");
    *value = number.get<double>();
  }
  return camera;
}

Result<Material> material_from(const Json& json) {
  const Json material = json.value("material", Json("plaster"));
  const std::string name = material.is_string() ? material.get<std::string>() : "";
  return parse_choice("material", name, material_choices);
}

Result<RenderOptions> render_from(const Json& json) {
  const auto width = number(json, "width", {1, 8192, 800}), height = number(json, "height", {1, 8192, 600});
  if (!width || !height || *width * *height > most_pixels)
    return wrong("width", "expected a picture of at most eight million pixels");
  RenderOptions render;
  render.width = static_cast<int>(*width);
  render.height = static_cast<int>(*height);
  render.is_fine = flag(json, "fine") && *width * *height <= most_fine_pixels;
  const auto light = direction(json, "light");
  if (!light && json.contains("light")) return wrong("light", "expected three numbers, not all of them 0");
  if (light) render.light = light->cast<float>();
  RELIEVO_TRY(render.material, material_from(json));
  RELIEVO_TRY(render.camera, camera_from(json.value("camera", Json::object())));
  RELIEVO_CHECK(check(render));
  return render;
}

Json number_or_null(double x) {
  return std::isfinite(x) ? Json(x) : Json();
}

Json to_json(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

// Rounds to thousandths, which keeps the HTTP header short. A thousandth is a quarter of a pixel in the
// page's curve.
Json rounded(const std::vector<double>& samples) {
  Json json = Json::array();
  for (const double sample : samples) json.push_back(std::round(sample * 1e3) / 1e3);
  return json;
}

}  // namespace

Result<Json> parse_body(std::string_view body) {
  Json json = Json::parse(body, nullptr, false);
  if (!json.is_object()) return wrong("body", "expected an object in JSON");
  return json;
}

Result<PictureRequest> picture_request(const Json& json) {
  PictureRequest request;
  RELIEVO_TRY(request.options,
              options_without_ornament_files(json.value("options", Json::object()), "options"));
  read_ornaments_of(request);
  RELIEVO_TRY(request.render, render_from(json));
  request.is_original = flag(json, "original");
  request.is_at_rest = flag(json, "fine");
  request.is_finished = flag(json, "finished");
  request.has_attention = flag(json, "attention");
  if (const auto turned = json.find("turned"); turned != json.end()) {
    RELIEVO_TRY(const View towards, view_from(*turned));
    request.turned = request.options.view;
    request.turned->R_view_model = towards.R_view_model;
    request.turned->is_best = false;
  }
  if (json.contains("u")) {
    request.u = number(json, "u", {0, 1e12, 1});
    if (!request.u) return wrong("u", "expected a number that is not negative");
  }
  return request;
}

Result<Vec2> place_from(const Json& json, const char* key) {
  const std::optional<Vec2> place = numbers<2>(json, key);
  if (!place) return wrong(key, "expected two numbers");
  if (place->cwiseAbs().maxCoeff() > 1e6) return wrong(key, "expected a place on the plate");
  return *place;
}

Result<std::vector<Vec2>> places_from(const Json& json) {
  const auto all = json.find("places");
  if (all == json.end() || !all->is_array() || all->size() > most_places)
    return wrong("places", cat("expected at most ", most_places, " places"));
  std::vector<Vec2> places;
  for (std::size_t i = 0; i < all->size(); ++i) {
    const std::optional<Vec2> place = numbers<2>(Json{{"place", (*all)[i]}}, "place");
    if (!place) return wrong("places", "expected two numbers for each place");
    places.push_back(*place);
  }
  return places;
}

Result<View> view_from(const Json& json) {
  if (!json.is_object()) return wrong("turned", "expected an object");
  const auto towards = direction(json, "towards"), up = direction(json, "up");
  if (!towards || !up) return wrong("towards", "expected directions as three numbers");
  return view_towards(*towards, *up);
}

// The form that is made from the brightness of a picture instead of heights.
static constexpr const char* lithophane = "lithophane";

OptionValues view_values(const Json& json) {
  OptionValues values;
  for (const OptionRow& option : option_table()) {
    if (!option.is_prepared()) continue;
    const auto found = json.find(option.name);
    const OptionValue value =
        found == json.end() ? option.initial : value_from_json(*found).value_or(OptionValue());
    if (value != OptionValue()) values.emplace(option.name, value);
  }
  if (json.value("form", Json()) == lithophane) values.emplace("form", std::string(lithophane));
  return values;
}

OptionValues first_view() {
  Json first = Json::object();
  for (const OptionRow& option : option_table())
    if (!option.in_studio.empty()) first[option.name] = option.in_studio;
  return view_values(first);
}

Result<ExportOrder> export_order_from(const Json& json) {
  const auto pixels = number(json, "pixels", {16, 16384, 2048});
  if (!pixels) return wrong("pixels", "expected a number from 16 to 16384");
  ExportOrder order;
  order.map.longer_side_px = static_cast<int>(*pixels);
  order.map.is_tiff = json.value("format", Json()) == "tiff";
  RELIEVO_TRY(const HeightMapTexts texts, height_map_texts(json));
  RELIEVO_CHECK(take_texts(texts, order.map));
  RELIEVO_TRY(order.material, material_from(json));
  return order;
}

// Returns the options for preparing a scan. An option without a value becomes null if the option is a number,
// and an empty text otherwise.
static Json view_json(const OptionValues& values) {
  Json json = Json::object();
  for (const OptionRow& option : option_table()) {
    if (!option.is_prepared()) continue;
    const auto found = values.find(option.name);
    const OptionValue& value = found == values.end() ? option.initial : found->second;
    if (option.is_number() && value == OptionValue())
      json[option.name] = nullptr;
    else
      std::visit([&](const auto& each) { json[option.name] = each; }, value);
  }
  json["form"] = values.contains("form") ? lithophane : "relief";
  return json;
}

Json to_json(const EngineStatus& status) {
  Json json{{"busy", status.is_busy},
            {"stage", status.stage},
            {"fraction", status.fraction},
            {"model", status.model},
            {"can_turn", status.can_turn},
            {"error", nullptr},
            {"input", nullptr},
            {"making", {{"stage", status.making_stage}, {"fraction", status.making_fraction}}},
            {"requested", view_json(status.view)}};
  if (status.error) json["error"] = error_json(*status.error);
  if (status.model > 0) json["input"] = to_json(status.input);
  return json;
}

Json to_json(const ModelFacts& facts) {
  const ScanReport& scan = facts.scan;
  Json remarks = Json::array();
  for (const auto& [text, option, value, effect] : facts.remarks)
    remarks.push_back({{"text", text}, {"option", option}, {"value", value}});
  std::vector<double> rotation;
  for (int i = 0; i < 9; ++i) rotation.push_back(facts.rotation(i / 3, i % 3));
  return {{"input_points", scan.input_points},
          {"visible_points", scan.visible_points},
          {"points", facts.points},
          {"triangles", facts.triangles},
          {"hull", facts.hull},
          {"size", {facts.size.x(), facts.size.y()}},
          {"origin", {facts.origin.x(), facts.origin.y()}},
          {"rho", scan.rho},
          {"noise", scan.removed_noise},
          {"delta", facts.delta},
          {"rotation", rotation},
          {"has_colours", facts.has_colours},
          {"can_be_lit", facts.can_be_lit},
          {"remarks", remarks},
          {"histogram", facts.histogram}};
}

Json to_json(const PictureAnswer& answer) {
  Json relief, reach;
  if (answer.reach) reach = {{"share", answer.reach->share}, {"left_mm", answer.reach->left_mm}};
  if (answer.relief_mm)
    for (const Vec2& corner : *answer.relief_mm) relief.push_back({corner.x(), corner.y()});
  return {{"width", answer.picture.image.width},
          {"height", answer.picture.image.height},
          {"pixels_per_mm", answer.picture.pixels_per_mm},
          {"is_finished", answer.is_finished},
          {"is_plain", answer.is_plain},
          {"has_ornaments", answer.has_ornaments},
          {"ornament_error", answer.ornament_error ? error_json(*answer.ornament_error) : Json()},
          {"curve", {{"share", rounded(answer.curve.share)}, {"kept", rounded(answer.curve.kept)}}},
          {"height_mm", answer.height_mm},
          {"relief_height_mm", answer.relief_height_mm},
          {"width_mm", answer.width_mm},
          {"size_mm", to_json(answer.size_mm)},
          {"is_size_exact", answer.is_size_exact},
          {"most_width_mm", answer.most_width_mm ? Json(*answer.most_width_mm) : Json()},
          {"relief_mm", relief},
          {"tool", reach},
          {"is_height_met", answer.is_height_met},
          {"u", number_or_null(answer.compression.u)},
          {"beta", answer.compression.beta},
          {"alpha", answer.compression.curve ? Json() : number_or_null(answer.compression.alpha())},
          {"solves", answer.times.solves},
          {"heights_ms", answer.times.heights_s * 1e3},
          {"after_solve_ms", answer.times.after_solve_s * 1e3},
          {"normals_ms", answer.times.normals_s * 1e3},
          {"drawing_ms", answer.drawing_s * 1e3}};
}

Json to_json(const OrnamentPlace& place) {
  const auto in_micrometres = [](double mm) { return std::round(mm * 1e3) / 1e3; };
  Json outlines = Json::array();
  for (const std::vector<Vec2>& outline : place.outlines) {
    Json& numbers = outlines.emplace_back(Json::array());
    for (const Vec2& p : outline) {
      numbers.push_back(in_micrometres(p.x()));
      numbers.push_back(in_micrometres(p.y()));
    }
  }
  Json at, error;
  if (place.at_mm) at = {in_micrometres(place.at_mm->x()), in_micrometres(place.at_mm->y())};
  if (place.error) error = error_json(*place.error);
  return {{"outlines", std::move(outlines)}, {"at", at}, {"error", error}};
}

Json view_list() {
  Json list = Json::array();
  for (const char* const name : {"front", "back", "left", "right", "top", "bottom"}) {
    const Mat3 rotation = parse_view(name).value_or(View{}).R_view_model;
    list.push_back({{"name", name},
                    {"towards", to_json(rotation.row(2).transpose())},
                    {"up", to_json(rotation.row(1).transpose())}});
  }
  return list;
}

Json material_list() {
  Json list = Json::array();
  for (std::size_t i = 0; i < material_choices.size(); ++i)
    list.push_back({{"id", material_choices[i].name}, {"name", material_names[i]}});
  return list;
}

Json error_json(const Error& error) {
  return {{"kind", name_of(error.kind)}, {"input", error.input}, {"text", error.message()}};
}

}  // namespace relievo::app::studio
