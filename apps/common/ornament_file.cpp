#include "common/read_inputs.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/files.h"
#include "common/wording.h"
#include "relievo/core/json_place.h"
#include "relievo/core/text.h"
#include "relievo/io/svg.h"

namespace relievo::app {
namespace {

using Json = nlohmann::json;

bool is_json(const std::string& text) {
  return text.starts_with('{');
}

template <typename T>
Result<void> set(T& to, Result<T> from) {
  if (!from) return std::unexpected(std::move(from).error());
  to = std::move(from.value());
  return {};
}

Result<std::shared_ptr<const FontFile>> read_font(const std::string& path) {
  RELIEVO_TRY(std::vector<std::byte> bytes, read_file(path));
  return std::make_shared<const FontFile>(path, std::move(bytes));
}

// Reads one list of ornaments. Errors name the key whose value is wrong.
class OrnamentReader {
 public:
  OrnamentReader(const std::string& name, const std::string& folder) : name_(name), folder_(folder) {}

  Result<std::vector<Ornament>> read(const Json& json) const {
    const auto list = json.is_object() ? json.find("ornaments") : json.end();
    if (!json.is_object() || list == json.end() || !list->is_array() || list->empty() || json.size() > 1)
      return input_error(name_, {}, "expected {\"ornaments\": [...]} with at least one" + found(json));
    constexpr std::size_t most = 200;
    if (list->size() > most)
      return input_error(name_, {}, cat("expected at most ", most, " ornaments, found more"));
    std::vector<Ornament> ornaments;
    for (std::size_t i = 0; i < list->size(); ++i) {
      RELIEVO_TRY(Ornament ornament, read_one((*list)[i], cat("ornaments[", i, "]")));
      ornaments.push_back(std::move(ornament));
    }
    return ornaments;
  }

 private:
  Result<Ornament> read_one(const Json& json, const std::string& place) const {
    if (!json.is_object()) return input_error(name_, place, "expected an object" + found(json));
    Ornament ornament;
    for (const auto& [key, value] : json.items()) {
      Result<void> done = read_key(key, value, ornament);
      if (!done && done.error().input.empty())
        done = input_error(name_, cat(place, ".", key), done.error().expected);
      RELIEVO_CHECK(std::move(done));
    }
    const bool has_text = !ornament.text.empty(), has_outlines = !ornament.outlines.empty();
    if (has_text != (ornament.kind == OrnamentKind::text))
      return input_error(name_, place, "expected a text with kind text, and with no other kind");
    if (has_outlines != (ornament.kind == OrnamentKind::drawing))
      return input_error(name_, place, "expected a file with kind drawing, and with no other kind");
    return ornament;
  }

  Result<void> read_key(const std::string& key, const Json& value, Ornament& to) const {
    if (key == "at") return read_place(value, to);
    if (key == "engraved") {
      if (!value.is_boolean()) return wrong("expected true or false", value);
      to.is_engraved = value.get<bool>();
      return {};
    }
    for (const auto& [name, member] : {std::pair{"size", &Ornament::size_mm},
                                       {"height", &Ornament::height_mm},
                                       {"inset", &Ornament::inset_mm},
                                       {"angle", &Ornament::angle_deg},
                                       {"count", &Ornament::count}})
      if (key == name) return read_number(value, (to.*member).emplace());
    if (key == "tracking") return read_number(value, to.tracking_mm);
    return read_text(key, value, to);
  }

  Result<void> read_text(const std::string& key, const Json& value, Ornament& to) const {
    constexpr std::string_view keys[] = {"kind", "text", "arc", "font", "file"};
    if (std::ranges::find(keys, key) == std::end(keys))
      return wrong(
          "expected kind, text, arc, font, file, size, height, inset, angle, at, tracking, count or engraved",
          key);
    if (!value.is_string()) return wrong("expected a text", value);
    const std::string text = value.get<std::string>();
    if (key == "kind") return set(to.kind, parse_choice({}, text, ornament_kinds));
    if (key == "arc") return set(to.arc, parse_choice({}, text, text_arc_choices));
    if (key == "font") return set(to.font, read_font(path_in(folder_, text)));
    if (key == "file") return read_drawing(path_in(folder_, text), to);
    to.text = text;
    return {};
  }

  static std::unexpected<Error> wrong(const char* expected, const Json& value) {
    return input_error({}, {}, expected + found(value));
  }

  static Result<void> read_number(const Json& value, double& to) {
    if (!value.is_number()) return wrong("expected a number", value);
    to = value.get<double>();
    return {};
  }

  static Result<void> read_place(const Json& value, Ornament& to) {
    if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number())
      return wrong("expected two lengths", value);
    to.at_mm = Vec2(value[0].get<double>(), value[1].get<double>());
    return {};
  }

  static Result<void> read_drawing(const std::string& path, Ornament& to) {
    RELIEVO_TRY(const std::vector<std::byte> bytes, read_file(path));
    return set(to.outlines, read_svg(text_in(bytes), path));
  }

  const std::string &name_, &folder_;
};

}  // namespace

Result<std::vector<Ornament>> parse_ornaments(std::string_view text, const std::string& name,
                                              const std::string& folder) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded())
    return input_error(name, json_error_place(text),
                       "expected ornaments in JSON, found text that is no JSON");
  return OrnamentReader(name, folder).read(json);
}

void find_ornament_files(OptionValues& own, const std::string& folder) {
  for (const char* const name : {"font", "ornaments"}) {
    const auto found = own.find(name);
    if (found == own.end() || !std::holds_alternative<std::string>(found->second)) continue;
    const std::string& path = std::get<std::string>(found->second);
    if (!path.empty() && !is_json(path)) found->second = path_in(folder, path);
  }
}

Result<void> read_ornaments(ReliefOptions& options) {
  const std::string &font = options.font_name, &source = options.ornament_source;
  if (!font.empty()) RELIEVO_CHECK(set(options.font, read_font(font)));
  if (source.empty()) return {};
  if (is_json(source)) return set(options.ornaments, parse_ornaments(source, "ornaments", {}));
  RELIEVO_TRY(const std::vector<std::byte> bytes, read_file(source));
  const std::string folder = std::filesystem::path(source).parent_path().string();
  return set(options.ornaments, parse_ornaments(text_in(bytes), source, folder));
}

}  // namespace relievo::app
