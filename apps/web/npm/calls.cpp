#include "web/calls.h"

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <variant>

#include "common/export_file.h"
#include "common/files.h"
#include "common/option_list.h"
#include "common/prepared_model.h"
#include "common/relief_files.h"
#include "common/stage_names.h"
#include "common/wording.h"
#include "relievo/core/choice.h"
#include "relievo/core/text.h"
#include "relievo/io/read.h"
#include "relievo/io/write.h"
#include "relievo/picture/height_map.h"
#include "relievo/samples/sample.h"
#include "relievo/scan/surface.h"

// Reports progress to the host. Returns 1 to cancel. The host provides this function in the module "relievo".
__attribute__((import_module("relievo"), import_name("progress"))) extern "C" int relievo_host_progress(
    const char* stage, std::size_t size, double fraction);

namespace relievo::app::web {
namespace {

using Json = nlohmann::json;
using Kept =
    std::variant<std::shared_ptr<FinishedRelief>, std::shared_ptr<PreparedModel>, std::shared_ptr<FrameInMm>>;

// Reports its progress to the host, which may cancel at the beginning of a stage.
struct HostProgress : Progress {
  HostProgress()
      : Progress([this](std::string_view stage, double fraction) {
          if (relievo_host_progress(stage.data(), stage.size(), fraction) != 0) cancel();
        }) {}
};

// Returns the objects that calls have made, keyed by their numbers. An object stays until a call releases it.
std::map<int, Kept>& kept() {
  static std::map<int, Kept> all;
  return all;
}

int keep(Kept made) {
  static int last = 0;
  kept().emplace(++last, std::move(made));
  return last;
}

double number(const Json& json, const char* key, double otherwise) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<double>() : otherwise;
}

int integer(const Json& json, const char* key, int otherwise) {
  return static_cast<int>(number(json, key, otherwise));
}

std::string text(const Json& json, const char* key, std::string otherwise = {}) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

// Reads {"inputs": [paths], "options": {name: number or text}, "base_image": path,
// "stream_above_mb": number}. All keys are optional. Options have the names of the command line; a length may
// be a text with a unit. Errors: kind option, with the option's name.
Result<MakeOrder> order_from(const Json& json) {
  MakeOrder order;
  const Json options = json.contains("options") ? json["options"] : Json::object();
  if (!options.is_object()) return option_error("options", "expected an object");
  for (const auto& [name, given] : options.items()) {
    if (given.is_null()) {
      order.unset.push_back(name);
      continue;
    }
    const OptionRow* const option = find_option(name);
    if (!option) return option_error(name, "expected the name of an option");
    const std::optional<OptionValue> value = value_from_json(given);
    if (!value) return option_error(name, std::string(expected_type(*option)));
    order.values.emplace(name, *value);
  }
  order.base_image_path = text(json, "base_image");
  order.scan_path = text(json, "scan");
  if (json.contains("stream_above_mb"))
    order.input_arguments.most_points =
        std::numeric_limits<double>::infinity();  // a caller who sets the limit in MB gets no other limit
  order.input_arguments.stream_above_mb =
      number(json, "stream_above_mb", order.input_arguments.stream_above_mb);
  if (const auto inputs = json.find("inputs"); inputs != json.end() && inputs->is_array())
    for (const Json& path : *inputs)
      if (path.is_string()) order.inputs.push_back(path.get<std::string>());
  return order;
}

// Returns the object that an earlier call made. The argument `relief`, `session` or `frame` has its number.
template <typename T>
Result<std::shared_ptr<T>> find(const Json& json) {
  const char* const key = std::is_same_v<T, FinishedRelief>  ? "relief"
                          : std::is_same_v<T, PreparedModel> ? "session"
                                                             : "frame";
  const auto found = kept().find(integer(json, key, 0));
  const auto* const made = found == kept().end() ? nullptr : std::get_if<std::shared_ptr<T>>(&found->second);
  if (!made) return option_error(key, "expected one that was not released");
  return *made;
}

std::vector<std::byte> bytes_of_all(const auto& values) {
  const auto bytes = std::as_bytes(std::span(values));
  return {bytes.begin(), bytes.end()};
}

// Answers with the numbers that `array` returns for an object of an earlier call.
template <typename T, auto array>
Result<CallAnswer> numbers_of(const Json& json) {
  RELIEVO_TRY(const auto made, find<T>(json));
  return CallAnswer{{}, bytes_of_all(array(*made))};
}

CallAnswer answer_of(std::shared_ptr<FinishedRelief> relief) {
  const Json report = relief->report(), remarks = relief->remarks();
  return CallAnswer{{{"relief", keep(std::move(relief))}, {"report", report}, {"remarks", remarks}}};
}

// --------------------------------------------------------------------------------------------------- making

Result<CallAnswer> about(const Json&) {
  Json facts = program_facts();
  facts["options"] = keyword_list();
  return CallAnswer{std::move(facts)};
}

Result<CallAnswer> make(const Json& json) {
  RELIEVO_TRY(MakeOrder order, order_from(json));
  HostProgress progress;
  RELIEVO_TRY(auto relief, relievo::app::make(std::move(order), progress));
  return answer_of(std::move(relief));
}

Result<CallAnswer> make_sample_file(const Json& json) {
  const SampleOptions options{static_cast<std::size_t>(number(json, "points", SampleOptions{}.points)),
                              number(json, "noise", SampleOptions{}.noise)};
  RELIEVO_TRY(const Cloud cloud, make_sample(text(json, "name"), options));
  return CallAnswer{{}, write_ply(cloud, {})};
}

// --------------------------------------------------------------------------------------------------- results

// Returns one file of a relief from the arguments {"relief", "path", "kind"}. `kind` is the name of a field
// of ReliefFiles.
Result<CallAnswer> file(const Json& json) {
  RELIEVO_TRY(const auto relief, find<FinishedRelief>(json));
  ReliefFiles files;
  RELIEVO_TRY(files.unit, parse_unit(text(json, "units", "mm")));
  files.heightmap_px = integer(json, "heightmap_px", files.heightmap_px);
  files.preview_px = integer(json, "preview_px", files.preview_px);
  if (files.heightmap_px < 16 || files.heightmap_px > 16384)
    return option_error("heightmap-size", cat("expected 16 to 16384 pixels, found ", files.heightmap_px));
  RELIEVO_CHECK(preview_options(files.preview_px, "plaster"));
  const std::string kind = text(json, "kind", "solid");
  std::string ReliefFiles::*const path = kind == "preview"        ? &ReliefFiles::preview
                                         : kind == "heightmap"    ? &ReliefFiles::heightmap
                                         : kind == "tool_picture" ? &ReliefFiles::tool_picture
                                                                  : &ReliefFiles::solid;
  files.*path = text(json, "path");
  if (kind == "solid" && !find_solid_format(ending_of(files.solid)))
    return option_error("output", cat("expected a file ending in ", either(solid_endings())));
  if (kind == "tool_picture" && !relief->made.report.reach)
    return option_error("tool-picture", "expected a tool, which it shows");
  if (kind == "heightmap") {
    RELIEVO_TRY(files.map, height_map_texts(json));
  }
  RELIEVO_TRY(MadeFiles made, relief_files(files, relief->made, relief->draft_deg));
  return CallAnswer{{}, std::move(made.files.at(0).bytes)};
}

Result<CallAnswer> heights(const Json& json) {
  RELIEVO_TRY(const auto relief, find<FinishedRelief>(json));
  const int size = integer(json, "size", 1024);
  if (size < 1 || size > 32768) return option_error("size", cat("expected 1 to 32768 pixels, found ", size));
  const MadeRelief& made = relief->made;
  const HeightsMm map = make_heights_mm(made.report.wrap ? made.flat : made.solid, {.longer_side_px = size});
  return CallAnswer{
      {{"width", map.image.width}, {"height", map.image.height}, {"mm_per_pixel", map.mm_per_pixel}},
      bytes_of_all(map.image.pixels)};
}

// -------------------------------------------------------------------------------------------------- sessions

Result<CallAnswer> open(const Json& json) {
  RELIEVO_TRY(MakeOrder order, order_from(json));
  HostProgress progress;
  RELIEVO_TRY(auto model, PreparedModel::prepare(std::move(order), progress));
  const Surface& surface = model->model().surface();
  Json about{{"points", surface.points.size()}, {"triangles", surface.triangulation.triangles.size()}};
  about["session"] = keep(std::move(model));
  return CallAnswer{std::move(about)};
}

Result<CallAnswer> make_of_session(const Json& json) {
  RELIEVO_TRY(const auto model, find<PreparedModel>(json));
  RELIEVO_TRY(const MakeOrder order, order_from(json));
  HostProgress progress;
  RELIEVO_TRY(auto relief, model->make(order, progress));
  return answer_of(std::move(relief));
}

Result<CallAnswer> frame(const Json& json) {
  RELIEVO_TRY(const auto model, find<PreparedModel>(json));
  RELIEVO_TRY(const MakeOrder order, order_from(json));
  RELIEVO_TRY(const auto made, model->frame(order));
  const Frame& f = made->frame;
  return CallAnswer{{{"frame", keep(made)},
                     {"height_mm", f.height * made->mm_per_unit},
                     {"is_height_met", f.is_height_met},
                     {"u", f.options.shape.compression.u}}};
}

Result<CallAnswer> picture(const Json& json) {
  RELIEVO_TRY(const auto model, find<PreparedModel>(json));
  RELIEVO_TRY(const auto shown, find<FrameInMm>(json));
  RenderOptions options;
  options.width = integer(json, "width", options.width);
  options.height = integer(json, "height", options.height);
  options.camera = {number(json, "yaw_deg", 0), number(json, "pitch_deg", 0), number(json, "zoom", 1)};
  options.is_fine = integer(json, "is_fine", 0) != 0;
  RELIEVO_TRY(const Picture made, model->picture(*shown, options, text(json, "material", "plaster")));
  return CallAnswer{
      {{"width", made.image.width}, {"height", made.image.height}, {"channels", made.image.channels}},
      bytes_of_all(made.image.pixels)};
}

// Returns the name that a user may have meant, from the arguments {"name", "names"}.
Result<CallAnswer> nearest(const Json& json) {
  std::vector<std::string> names;
  if (const auto known = json.find("names"); known != json.end() && known->is_array())
    for (const Json& name : *known)
      if (name.is_string()) names.push_back(name.get<std::string>());
  return CallAnswer{{{"name", nearest_name(text(json, "name"), names)}}};
}

Result<CallAnswer> release(const Json& json) {
  kept().erase(integer(json, "number", 0));
  return CallAnswer{};
}

using Function = Result<CallAnswer> (*)(const Json&);
constexpr std::pair<std::string_view, Function> functions[] = {
    {"about", about},
    {"make", make},
    {"sample", make_sample_file},
    {"file", file},
    {"heights", heights},
    {"vertices", numbers_of<FinishedRelief, [](const auto& r) { return std::span(r.made.solid.points); }>},
    {"faces", numbers_of<FinishedRelief, [](const auto& r) { return std::span(r.made.solid.triangles); }>},
    {"open", open},
    {"session_make", make_of_session},
    {"frame", frame},
    {"frame_heights", numbers_of<FrameInMm, [](const auto& f) { return std::span(f.frame.heights); }>},
    {"surface_points",
     numbers_of<PreparedModel, [](const auto& m) { return std::span(m.model().surface().points); }>},
    {"surface_triangles",
     numbers_of<PreparedModel,
                [](const auto& m) { return std::span(m.model().surface().triangulation.triangles); }>},
    {"picture", picture},
    {"nearest", nearest},
    {"release", release}};

}  // namespace

Result<CallAnswer> call(std::string_view name, const Json& arguments) {
  for (const auto& [known, function] : functions)
    if (known == name) return function(arguments);
  return option_error("call", cat("expected the name of a function, found '", name, "'"));
}

}  // namespace relievo::app::web
