#include "common/scene_file.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/files.h"
#include "common/wording.h"
#include "relievo/core/json_place.h"
#include "relievo/core/text.h"

namespace relievo::app {
namespace {

using Json = nlohmann::json;

class SceneReader {
 public:
  explicit SceneReader(const std::string& name) : name_(name) {}

  Result<std::vector<SceneEntry>> read(const Json& scene) const {
    if (!scene.is_object()) return fail({}, "expected a scene in JSON, {\"models\": [...]}" + found(scene));
    RELIEVO_CHECK(check_keys(scene, {}, {"models"}));
    const auto models = scene.find("models");
    if (models == scene.end() || !models->is_array() || models->empty())
      return fail("models", "expected a list of at least one model" + found(scene.value("models", Json())));
    std::vector<SceneEntry> entries;
    for (std::size_t i = 0; i < models->size(); ++i) {
      RELIEVO_TRY(SceneEntry entry, read_model((*models)[i], cat("models[", i, "]")));
      entries.push_back(std::move(entry));
    }
    return entries;
  }

 private:
  std::unexpected<Error> fail(std::string place, std::string expected) const {
    return input_error(name_, std::move(place), std::move(expected));
  }

  Result<void> check_keys(const Json& object, const std::string& place,
                          std::initializer_list<std::string_view> known) const {
    for (const auto& [key, value] : object.items())
      if (std::ranges::find(known, key) == known.end()) {
        std::string names;
        for (const std::string_view name : known) names += cat(names.empty() ? "" : ", ", name);
        return fail(place, cat("expected ", known.size() > 1 ? "only the keys " : "only the key ", names,
                               ", found '", key, "'"));
      }
    return {};
  }

  Result<SceneEntry> read_model(const Json& model, const std::string& place) const {
    if (!model.is_object()) return fail(place, "expected an object" + found(model));
    RELIEVO_CHECK(check_keys(model, place, {"file", "rotate", "translate", "scale", "mirror", "height"}));
    SceneEntry entry;
    RELIEVO_CHECK(read_path(model, place + ".file", entry.path));
    RELIEVO_CHECK(read_pose(model, place, entry.pose));
    return entry;
  }

  Result<void> read_path(const Json& model, const std::string& place, std::string& path) const {
    const auto file = model.find("file");
    if (file == model.end() || !file->is_string())
      return fail(place, "expected the name of a file" + found(model.value("file", Json())));
    path = (std::filesystem::path(name_).parent_path() / file->get<std::string>()).string();
    if (!is_there(path)) return fail(place, cat("expected a file that is there, found no '", path, "'"));
    return {};
  }

  Result<void> read_pose(const Json& model, const std::string& place, Pose& pose) const {
    if (const auto turn = model.find("rotate"); turn != model.end())
      RELIEVO_CHECK(read_three(*turn, place + ".rotate", "angles in degrees", pose.rotate_deg));
    if (const auto move = model.find("translate"); move != model.end())
      RELIEVO_CHECK(read_three(*move, place + ".translate", "lengths", pose.translate.emplace()));
    if (const auto scale = model.find("scale"); scale != model.end()) {
      if (!scale->is_number() || !(scale->get<double>() >= 1e-6 && scale->get<double>() <= 1e6))
        return fail(place + ".scale", "expected a number from 1e-06 to 1e+06" + found(*scale));
      pose.scale = scale->get<double>();
    }
    if (const auto mirror = model.find("mirror"); mirror != model.end()) {
      if (!mirror->is_boolean()) return fail(place + ".mirror", "expected true or false" + found(*mirror));
      pose.is_mirrored = mirror->get<bool>();
    }
    if (const auto height = model.find("height"); height != model.end()) {
      if (!height->is_number() ||
          !(height->get<double>() >= least_own_height && height->get<double>() <= most_own_height))
        return fail(place + ".height", cat("expected a share of the relief's height from ", least_own_height,
                                           " to ", most_own_height, found(*height)));
      pose.height = height->get<double>();
    }
    return {};
  }

  Result<void> read_three(const Json& values, const std::string& place, const char* what, Vec3& to) const {
    const auto is_number = [](const Json& value) { return value.is_number(); };
    if (!values.is_array() || values.size() != 3 || !std::ranges::all_of(values, is_number))
      return fail(place, cat("expected three ", what, found(values)));
    for (int axis = 0; axis < 3; ++axis) to[axis] = values[static_cast<std::size_t>(axis)].get<double>();
    return {};
  }

  const std::string& name_;
};

}  // namespace

Result<std::vector<SceneEntry>> read_scene_file(std::string_view text, const std::string& name) {
  const Json scene = Json::parse(text, nullptr, false);
  if (scene.is_discarded())
    return input_error(name, json_error_place(text),
                       "expected a scene in JSON, {\"models\": [...]}, found text that is no JSON");
  return SceneReader(name).read(scene);
}

}  // namespace relievo::app
