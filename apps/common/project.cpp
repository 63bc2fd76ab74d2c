#include "common/project.h"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/descriptor.h"
#include "common/files.h"
#include "common/wording.h"
#include "relievo/core/json_place.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/samples/sample.h"
#include "relievo/scan/scan_file.h"

namespace relievo::app {
namespace {

using Json = nlohmann::json;

std::unexpected<Error> fail(std::string_view name, std::string_view place, std::string expected) {
  return input_error(std::string(name), std::string(place), std::move(expected));
}

std::string text_or_nothing(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

constexpr const char* base_image_name = "base-image";

// Returns the options in the JSON object except for the height map of a base, which is not in the table of
// options.
Result<OptionValues> values_without_image(Json json, std::string_view name) {
  if (!base_image_path_in(json).empty()) json.erase(base_image_name);
  return values_from_json(json, name);
}

// Caches the last height map that was read, since successive pictures need the same one.
struct LastImage {
  std::string path;
  std::int64_t changed_ns;
  std::shared_ptr<const Image<float>> image;
};

Result<std::shared_ptr<const Image<float>>> last_base_image(const std::string& path) {
  if (path.empty()) return nullptr;
  static Guarded<LastImage> guarded;
  return guarded.with([&](LastImage& last) -> Result<std::shared_ptr<const Image<float>>> {
    const std::int64_t changed_ns = time_of_change_ns(path);
    if (last.image && last.path == path && last.changed_ns == changed_ns) return last.image;
    RELIEVO_TRY(std::shared_ptr<const Image<float>> image, read_base_image(path));
    last = {path, changed_ns, image};
    return image;
  });
}

}  // namespace

OptionValues with_given(OptionValues own, const OptionValues& given) {
  const auto has = [&](std::string_view name) { return given.contains(name); };
  const auto drop = [&](std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names)
      if (const auto found = own.find(name); found != own.end()) own.erase(found);
  };
  // Each of these four options determines the height, so only one of them may stay. The option ground is
  // valid only with mm-per-value.
  const bool has_scale = has("mm-per-value");
  if (has("height") || has("height-of-diagonal") || has("alpha") || has_scale) {
    drop({"height", "height-of-diagonal", "alpha", "mm-per-value"});
    if (!has_scale) drop({"ground"});
  }
  if (has("alpha") || has_scale) drop({"method"});  // alpha implies the method paper, mm-per-value linear
  if (has("method") && given.at("method") != OptionValue("paper")) drop({"alpha"});
  if (has("method") && given.at("method") != OptionValue("linear")) drop({"mm-per-value", "ground"});
  // A diameter implies the outline circle, which has no width and height of its own.
  if (has("diameter") || (has("plate") && own.contains("diameter"))) drop({"outline"});
  if (has("plate") || has("diameter")) drop({"plate", "diameter"});
  for (const auto& [name, value] : given) own.insert_or_assign(name, value);
  return own;
}

Json to_json(const OptionValues& options) {
  Json json = Json::object();
  for (const OptionRow& option : option_table()) {
    const auto found = options.find(option.name);
    const OptionValue& value = found == options.end() ? option.initial : found->second;
    if (value == OptionValue()) continue;
    std::visit([&](const auto& each) { json[option.name] = each; }, value);
  }
  return json;
}

std::optional<OptionValue> value_from_json(const Json& json) {
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  return std::nullopt;
}

Result<OptionValues> values_from_json(const Json& given, std::string_view name) {
  if (!given.is_object()) return fail(name, "options", "expected an object" + found(given));
  OptionValues values;
  for (const auto& [key, json] : given.items()) {
    const OptionRow* const option = find_option(key);
    if (!option) return fail(name, "options", cat("expected known options, found '", key, "'"));
    const std::optional<OptionValue> value = value_from_json(json);
    if (!value || std::holds_alternative<double>(*value) != option->is_number())
      return fail(name, cat("options.", key),
                  (option->is_number() ? "expected a number" : "expected a text") + found(json));
    if (*value != option->initial) values.emplace(key, *value);
  }
  return values;
}

std::string base_image_path_in(const Json& options) {
  return options.is_object() ? text_or_nothing(options, base_image_name) : std::string();
}

Result<ReliefOptions> options_without_ornament_files(const Json& json, std::string_view name) {
  RELIEVO_TRY(const OptionValues values, values_without_image(json, name));
  RELIEVO_TRY(ReliefOptions options, parse_options(values));
  RELIEVO_CHECK(parse_depth(values));
  RELIEVO_TRY(std::shared_ptr<const Image<float>> image, last_base_image(base_image_path_in(json)));
  RELIEVO_CHECK(take_base_image(std::move(image), options.base));
  return options;
}

Result<ReliefOptions> options_from_json(const Json& json, std::string_view name) {
  RELIEVO_TRY(ReliefOptions options, options_without_ornament_files(json, name));
  RELIEVO_CHECK(read_ornaments(options));
  return options;
}

bool is_same(const ScanSource& a, const ScanSource& b) {
  return a.sample == b.sample && a.path == b.path;
}

Json to_json(const ScanSource& input) {
  if (!input.sample.empty()) return {{"sample", input.sample}, {"name", input.name}};
  return {{"path", input.path}, {"name", input.name}, {"hash", input.hash}};
}

Result<ScanSource> input_from_json(const Json& json, std::string_view name) {
  if (!json.is_object()) return fail(name, "input", "expected an object" + found(json));
  ScanSource input{text_or_nothing(json, "sample"), text_or_nothing(json, "path"),
                   text_or_nothing(json, "name"), text_or_nothing(json, "hash")};
  if (input.sample.empty() == input.path.empty())
    return fail(name, "input",
                cat("expected either a path or a sample, found ", input.path.empty() ? "none" : "both"));
  if (input.name.empty())
    input.name = input.sample.empty() ? std::filesystem::path(input.path).filename().string() : input.sample;
  return input;
}

Result<Project> read_project(std::string_view text, std::string_view name) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded())
    return fail(name, json_error_place(text), "expected a project in JSON, found text that is none");
  if (!json.is_object()) return fail(name, {}, "expected a project in JSON" + found(json));
  if (!json.contains("relievo") || json["relievo"] != 1)
    return fail(name, "relievo", "expected a project of version 1" + found(json.value("relievo", Json())));
  RELIEVO_TRY(const ScanSource input, input_from_json(json.value("input", Json()), name));
  const Json options = json.value("options", Json());
  RELIEVO_TRY(const OptionValues values, values_without_image(options, name));
  return Project{input, values, base_image_path_in(options)};
}

void FileHash::append(std::string_view bytes) {
  for (const char byte : bytes) hash_ = (hash_ ^ static_cast<unsigned char>(byte)) * 0x100000001B3U;
}

std::string FileHash::text() const {
  constexpr char digits[] = "0123456789abcdef";
  std::string text(16, '0');
  std::uint64_t rest = hash_;
  for (int i = 15; i >= 0; --i, rest >>= 4) text[static_cast<std::size_t>(i)] = digits[rest & 15];
  return "fnv1a64:" + text;
}

std::string hash_of(std::string_view bytes) {
  FileHash hash;
  hash.append(bytes);
  return hash.text();
}

Result<std::string> hash_of_file(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file.is_open()) return system_error(ErrorKind::input, path, "expected a file that can be read");
  FileHash hash;
  std::vector<char> piece(1 << 20);
  for (;;) {
    const ssize_t got = ::read(file.number(), piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return system_error(ErrorKind::input, path, "expected a file that can be read");
    if (got == 0) return hash.text();
    hash.append({piece.data(), static_cast<std::size_t>(got)});
  }
}

Result<Scene> load_scan(ScanSource& input, std::span<const std::byte> bytes, const std::string& path,
                        const LoadOptions& options) {
  const std::string hash = hash_of(text_in(bytes));
  if (!input.hash.empty() && input.hash != hash)
    return fail(path, {}, cat("expected the file as it was, ", input.hash, ", found ", hash));
  input.hash = hash;
  if (options.is_unwanted && options.is_unwanted()) return cancelled_error();
  const PointsWanted wanted{{}, options.in.depth.points};
  if (is_scene_file(path)) return read_scene({path}, options.in, wanted, nullptr);
  RELIEVO_TRY(SceneModel model, parse_input(bytes, path, options.in, wanted.points, nullptr));
  model.name = input.name;
  return Scene{{std::move(model)}};
}

Result<Scene> load_input(ScanSource& input, const std::string& folder, const LoadOptions& options) {
  if (!input.sample.empty()) {
    RELIEVO_TRY(Cloud sample, make_sample(input.sample));
    return Scene{{{input.sample, std::make_shared<const CloudFile>(std::move(sample), "sample")}}};
  }
  const std::string path = (std::filesystem::path(folder) / input.path).string();
  RELIEVO_TRY(const std::vector<std::byte> bytes, read_file(path));
  if (options.is_unwanted && options.is_unwanted()) return cancelled_error();
  return load_scan(input, bytes, path, options);
}

}  // namespace relievo::app
