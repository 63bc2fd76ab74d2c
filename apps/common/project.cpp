#include "common/project.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "common/descriptor.h"
#include "common/files.h"
#include "common/read_inputs.h"
#include "common/wording.h"
#include "relievo/core/json_place.h"
#include "relievo/core/option_field.h"
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

// Takes one field from the JSON if it is there; remembers the first of a wrong type.
struct FieldReader {
  const Json& json;
  std::string wrong, wrong_type;
  std::size_t taken = 0;

  void operator()(const OptionField& field, double& value) { take(field, value, json_number); }
  void operator()(const OptionField& field, std::optional<double>& value) { take(field, value, json_number); }
  void operator()(const OptionField& field, std::string& value) {
    take(field, value, [](const Json& j) { return j.is_string(); });
  }

  static bool json_number(const Json& j) { return j.is_number(); }

  template <typename T, typename IsRight>
  void take(const OptionField& field, T& value, IsRight is_right) {
    using Value = std::conditional_t<std::is_same_v<T, std::string>, std::string, double>;
    const auto found = json.find(field.name);
    if (found == json.end()) return;
    ++taken;
    if (is_right(*found)) {
      value = found->template get<Value>();
    } else if (wrong.empty()) {
      wrong = field.name;
      wrong_type = std::is_same_v<T, std::string> ? "expected a text" : "expected a number";
    }
  }
};

std::string unknown_name(const Json& json) {
  for (const auto& [key, value] : json.items()) {
    const auto is_known = [&](const ReliefField& field) { return field.name == key; };
    if (std::ranges::none_of(option_fields(), is_known)) return key;
  }
  return {};
}

constexpr const char* base_image_name = "base-image";

}  // namespace

OptionTexts with_given(OptionTexts own, const OptionTexts& given,
                       const std::function<bool(std::string_view)>& is_given) {
  if (is_given("alpha")) own.height_mm = std::nullopt;
  if (is_given("alpha") && !is_given("method")) own.method.clear();  // which is then the paper's
  for (const ReliefField& field : option_fields())
    if (is_given(field.name))
      std::visit([&](const auto member) { own.*member = given.*member; }, field.value);
  return own;
}

Json to_json(const OptionTexts& options) {
  Json json = Json::object();
  visit(options, [&]<typename T>(const OptionField& field, const T& value) {
    const std::string key(field.name);
    if constexpr (std::is_same_v<T, std::optional<double>>) {
      if (value) json[key] = *value;
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (!value.empty()) json[key] = value;
    } else {
      json[key] = value;
    }
  });
  return json;
}

Result<OptionTexts> texts_from_json(const Json& json, std::string_view name) {
  if (!json.is_object()) return fail(name, "options", "expected an object" + found(json));
  OptionTexts options;
  FieldReader reader{json, {}, {}};
  visit(options, reader);
  if (!reader.wrong.empty())
    return fail(name, cat("options.", reader.wrong), reader.wrong_type + found(json[reader.wrong]));
  if (reader.taken != json.size())
    return fail(name, "options", cat("expected known options, found '", unknown_name(json), "'"));
  return options;
}

std::string base_image_path_in(const Json& options) {
  return options.is_object() ? text_or_nothing(options, base_image_name) : std::string();
}

namespace {

// Returns the options of the table alone: the height map of a base is none of them.
Result<OptionTexts> texts_without_image(Json json, std::string_view name) {
  if (!base_image_path_in(json).empty()) json.erase(base_image_name);
  return texts_from_json(json, name);
}

// The height map that was read last, for pictures that follow one another.
struct LastImage {
  std::string path;
  timespec changed;
  std::shared_ptr<const Image<float>> image;
};

Result<std::shared_ptr<const Image<float>>> last_base_image(const std::string& path) {
  if (path.empty()) return nullptr;
  static Guarded<LastImage> guarded;
  return guarded.with([&](LastImage& last) -> Result<std::shared_ptr<const Image<float>>> {
    struct stat now = {};
    if (::stat(path.c_str(), &now) != 0) now = {};  // which reading explains
    const auto [seconds, nanoseconds] = now.st_mtim;
    if (last.image && last.path == path && last.changed.tv_sec == seconds &&
        last.changed.tv_nsec == nanoseconds)
      return last.image;
    RELIEVO_TRY(std::shared_ptr<const Image<float>> image, read_base_image(path));
    last = {path, now.st_mtim, image};
    return image;
  });
}

}  // namespace

Result<ReliefOptions> options_from_json(const Json& json, std::string_view name) {
  RELIEVO_TRY(const OptionTexts texts, texts_without_image(json, name));
  RELIEVO_TRY(ReliefOptions options, parse_options(texts));
  RELIEVO_TRY(std::shared_ptr<const Image<float>> image, last_base_image(base_image_path_in(json)));
  RELIEVO_CHECK(take_base_image(std::move(image), options.base));
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
  RELIEVO_TRY(const OptionTexts texts, texts_without_image(options, name));
  return Project{input, texts, base_image_path_in(options)};
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

namespace {

Scene scene_of(const std::string& name, LoadedFile read) {
  return {{{name, std::make_shared<const CloudFile>(std::move(read.file)), {}, std::move(read.remarks)}}};
}

}  // namespace

Result<Scene> load_scan(ScanSource& input, std::span<const std::byte> bytes, const std::string& path,
                        const std::function<bool()>& is_unwanted) {
  const std::string hash = hash_of(text_in(bytes));
  if (!input.hash.empty() && input.hash != hash)
    return fail(path, {}, cat("expected the file as it was, ", input.hash, ", found ", hash));
  input.hash = hash;
  if (is_unwanted && is_unwanted()) return cancelled_error();
  if (is_scene_file(path)) {
    Result<SceneInput> read = read_scene({path}, {}, {}, nullptr);
    if (!read) return std::unexpected(read.error());
    return std::move(read->scene);
  }
  Result<LoadedFile> read = parse_input(bytes, path, {}, PointsWanted{}.points, nullptr);
  if (!read) return std::unexpected(read.error());
  return scene_of(input.name, std::move(*read));
}

Result<Scene> load_input(ScanSource& input, const std::string& folder,
                         const std::function<bool()>& is_unwanted) {
  if (!input.sample.empty()) {
    Result<Cloud> sample = make_sample(input.sample);
    if (!sample) return std::unexpected(sample.error());
    return scene_of(input.sample, {{std::move(*sample), "sample"}, {}});
  }
  const std::string path = (std::filesystem::path(folder) / input.path).string();
  const Result<std::vector<std::byte>> bytes = read_file(path);
  if (!bytes) return std::unexpected(bytes.error());
  if (is_unwanted && is_unwanted()) return cancelled_error();
  return load_scan(input, *bytes, path, is_unwanted);
}

}  // namespace relievo::app
