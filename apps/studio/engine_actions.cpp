// Performs the actions that need a document's engine, and collects the facts that the page needs at its
// start.
#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>

#include "common/export_file.h"
#include "common/files.h"
#include "common/option_list.h"
#include "common/scene_file.h"
#include "common/stage_names.h"
#include "relievo/core/text.h"
#include "relievo/io/read.h"
#include "studio/actions.h"
#include "studio/requests.h"

namespace relievo::app::studio {

namespace {

using Json = nlohmann::json;

Result<ReliefOptions> options_in(const Json& json) {
  return options_from_json(json.value("options", Json()), "options");
}

// Returns the models of a scene file and their poses, in the JSON form that scene files have; an empty array
// for other scans.
Json models_of(const ScanSource& input) {
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
    if (pose.height) models.back()["height"] = *pose.height;
    if (const auto& move = pose.translate) models.back()["translate"] = {move->x(), move->y(), move->z()};
  }
  return models;
}

struct UseInfo {
  PixelUse use;
  std::string_view name;
  Colour colour;
};

// People with any kind of colour blindness can distinguish these colours from each other and from greys.
constexpr std::array<UseInfo, 3> left_out{{{PixelUse::missing, "missing", {136, 34, 85}},
                                           {PixelUse::background, "background", {51, 122, 183}},
                                           {PixelUse::blur, "blur", {230, 150, 0}}}};

Colour colour_of(PixelUse use) {
  return std::ranges::find(left_out, use, &UseInfo::use)->colour;
}

// Maps depths of points to greys: the nearest point is white, and the farthest point is dark.
class GreyOfDepth {
 public:
  explicit GreyOfDepth(const Cloud& cloud) : cloud_(cloud) {
    for (const Vec3& p : cloud.points) low_ = std::min(low_, p.z()), high_ = std::max(high_, p.z());
  }

  Colour operator()(std::size_t point) const {
    constexpr double dark = 60, white = 255;
    const double share = high_ > low_ ? (cloud_.points[point].z() - low_) / (high_ - low_) : 1;
    const auto grey = static_cast<std::uint8_t>(dark + share * (white - dark));
    return {grey, grey, grey};
  }

 private:
  const Cloud& cloud_;
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

std::string in_hexadecimal(const Colour& colour) {
  constexpr char digits[] = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t part : colour) text += {digits[part / 16], digits[part % 16]};
  return text;
}

// Returns a picture of a depth image, with one pixel for each of PixelUses::uses. Kept pixels are grey, and
// the nearer they are the brighter they are. All other pixels have the colour of their use. The model must
// have pixels.
Picture picture_of_uses(const SceneModel& image) {
  const Image<PixelUse>& uses = image.pixels->uses;
  const Cloud& cloud = image.file->cloud;
  const GreyOfDepth grey(cloud);
  const bool is_photo = cloud.has_colours();  // a photo has a point for every pixel, even for missing ones
  Picture picture;
  picture.image.resize(uses.width, uses.height, 4);
  std::size_t point = 0;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const bool is_kept = uses[i] == PixelUse::kept;
    const Colour colour = !is_kept ? colour_of(uses[i]) : is_photo ? cloud.colours[i] : grey(point);
    point += is_kept;
    std::ranges::copy(colour, &picture.image[4 * i]);
    picture.image[4 * i + 3] = 255;
  }
  return picture;
}

// Returns facts about a depth image: the meaning of its values; whether the values became a surface or the
// brightness of a lithophane; whether the values are proportional to heights; the width of the image divided
// by its height; the number of pixels; and, for each use of pixels except `kept`, the use's name, its colour
// and the number of its pixels. The model must have pixels.
Json uses_json(const SceneModel& image) {
  const PixelUses& pixels = *image.pixels;
  const std::size_t block =
      static_cast<std::size_t>(pixels.reduction) * static_cast<std::size_t>(pixels.reduction);
  Json uses = Json::array();
  for (const UseInfo& info : left_out)
    uses.push_back(
        {{"use", info.name},
         {"colour", in_hexadecimal(info.colour)},
         {"pixels", block * static_cast<std::size_t>(std::ranges::count(pixels.uses.pixels, info.use))}});
  return {
      {"values", name_in(depth_value_choices, pixels.values)},
      {"is_surface", !image.file->cloud.has_colours()},
      {"is_scaled", image.file->cloud.units_per_value.value_or(0) != 0},
      {"aspect", pixels.uses.width * pixels.pixel_shape.x() / (pixels.uses.height * pixels.pixel_shape.y())},
      {"pixels", block * pixels.uses.size()},
      {"uses", std::move(uses)}};
}

Result<Answer> view(Engine& engine, const Json& json) {
  RELIEVO_CHECK(engine.choose_view(view_values(json)));
  return answer_of(Json::object());
}

Result<Answer> cancel(Engine& engine, const Json&) {
  engine.cancel();
  return answer_of(Json::object());
}

Result<Answer> facts(Engine& engine, const Json&) {
  RELIEVO_TRY(const ModelFacts facts, engine.facts());
  Json told = to_json(facts);
  told["models"] = models_of(engine.status().input);
  const auto image = engine.depth_image();
  told["depth_image"] = image ? uses_json(*image) : Json();
  return answer_of(told);
}

Result<Answer> views(Engine& engine, const Json&) {
  RELIEVO_TRY(const std::vector<ViewGuess> views, engine.suggest_views());
  Json sides = Json::array();
  for (const ViewGuess& side : views) sides.push_back({{"view", side.name}, {"up", side.up}});
  return answer_of(Json{{"views", sides}});
}

Result<Answer> picture(Engine& engine, const Json& json) {
  RELIEVO_TRY(PictureRequest request, picture_request(json));
  RELIEVO_TRY(const PictureAnswer made, engine.picture(std::move(request)));
  return answer_of(made.picture, to_json(made));
}

Result<Answer> scan(Engine& engine, const Json& json) {
  RELIEVO_TRY(const View view, view_from(json));
  RELIEVO_TRY(const PictureRequest size, picture_request(json));
  RELIEVO_TRY(const Picture picture, engine.scan_picture(view, size.render.width, size.render.height));
  return answer_of(picture, {{"width", picture.image.width}, {"height", picture.image.height}});
}

// Answers with a picture that shows how the pixels of a depth image were used.
Result<Answer> pixels(Engine& engine, const Json&) {
  const auto image = engine.depth_image();
  if (!image) return refusal(409, "expected a depth image to be open");
  const Picture picture = picture_of_uses(*image);
  return answer_of(picture, {{"width", picture.image.width}, {"height", picture.image.height}});
}

Result<Answer> profile(Engine& engine, const Json& json) {
  RELIEVO_TRY(PictureRequest request, picture_request(json));
  RELIEVO_TRY(const Vec2 from, place_from(json, "from"));
  RELIEVO_TRY(const Vec2 until, place_from(json, "to"));
  RELIEVO_TRY(const std::vector<float> heights, engine.profile(std::move(request), {from, until}));
  return answer_of(Json{{"heights_mm", heights}});
}

// Answers with the points of the model under positions in its picture; null for positions beside the model.
Result<Answer> points(Engine& engine, const Json& json) {
  RELIEVO_TRY(const std::vector<Vec2> places, places_from(json));
  RELIEVO_TRY(const auto found, engine.points_under(places));
  Json points = Json::array();
  for (const std::optional<Vec3>& point : found)
    points.push_back(point ? Json{point->x(), point->y(), point->z()} : Json());
  return answer_of(Json{{"points", points}});
}

Result<Answer> reach(Engine& engine, const Json& json) {
  RELIEVO_TRY(PictureRequest request, picture_request(json));
  RELIEVO_TRY(const double height_mm, engine.reachable_height(std::move(request)));
  return answer_of(Json{{"height_mm", height_mm}});
}

// Returns the outlines of the ornaments, as numbers x, y, x, y ... in mm from the middle of the piece.
Result<Answer> ornaments(Engine& engine, const Json& json) {
  RELIEVO_TRY(const ReliefOptions options, options_in(json));
  RELIEVO_TRY(const std::vector<OrnamentPlace> places, engine.ornament_places(options));
  Json all = Json::array();
  for (const OrnamentPlace& place : places) all.push_back(to_json(place));
  return answer_of(Json{{"ornaments", std::move(all)}});
}

double front_mm(const Solid& solid) {
  Box box;
  for (std::size_t t = 0; t < solid.front_triangles; ++t)
    for (const Index i : solid.triangles[t]) box.extend(solid.points[i]);
  return box.size().z();
}

Result<Answer> piece(Engine& engine, const Json& json) {
  RELIEVO_TRY(const ReliefOptions options, options_in(json));
  RELIEVO_TRY(const auto made, engine.piece(options));
  const Solid& solid = made->solid;
  const Vec3 size = Box::of(solid.points).size();
  return answer_of(Json{{"triangles", solid.triangles.size()},
                        {"points", solid.points.size()},
                        {"size_mm", {size.x(), size.y(), size.z()}},
                        {"height_mm", relief_height_mm(*made, options)},
                        {"front_mm", front_mm(made->report.wrap ? made->flat : solid)}});
}

Result<Answer> cancel_piece(Engine& engine, const Json&) {
  engine.cancel_making();
  return answer_of(Json::object());
}

Result<Answer> make_file(Engine& engine, const Json& json) {
  RELIEVO_TRY(const ReliefOptions options, options_in(json));
  RELIEVO_TRY(const ExportOrder order, export_order_from(json));
  RELIEVO_TRY(const FileFormat* const format, find_format(json.value("format", "")));
  RELIEVO_TRY(const auto made, engine.piece(options));
  RELIEVO_TRY(ExportedFile file, export_file(*made, *format, order));
  return Answer{200, std::move(file.type), std::move(file.bytes)};
}

}  // namespace

EngineAction find_engine_action(std::string_view name) {
  static constexpr std::pair<std::string_view, EngineAction> actions[] = {{"view", view},
                                                                          {"cancel", cancel},
                                                                          {"facts", facts},
                                                                          {"views", views},
                                                                          {"picture", picture},
                                                                          {"scan", scan},
                                                                          {"pixels", pixels},
                                                                          {"profile", profile},
                                                                          {"points", points},
                                                                          {"reach", reach},
                                                                          {"ornaments", ornaments},
                                                                          {"piece", piece},
                                                                          {"cancel_piece", cancel_piece},
                                                                          {"export", make_file}};
  const auto* const found =
      std::ranges::find(actions, name, &std::pair<std::string_view, EngineAction>::first);
  return found == std::end(actions) ? nullptr : found->second;
}

// Checks that the options are valid and do not contradict each other.
Result<Answer> Actions::check(const nlohmann::json& json) {
  RELIEVO_CHECK(options_in(json));
  return answer_of(Json::object());
}

nlohmann::json Actions::about() {
  Json all = program_facts();
  const Lock lock(storing_);
  all.update({{"options", option_list()},
              {"readable", readable_formats()},
              {"views", view_list()},
              {"materials", material_list()},
              {"curve", {{"most_points", ToneCurve::most_points}}},
              {"recent", recent_list()},
              {"first", first_},
              {"notice", store_.notice()},
              {"most_upload", most_scan}});
  return all;
}

}  // namespace relievo::app::studio
