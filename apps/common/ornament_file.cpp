#include "common/read_inputs.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "common/files.h"
#include "common/wording.h"
#include "relievo/core/json_place.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/io/svg.h"

namespace relievo::app {
namespace {

using Json = nlohmann::json;

// Returns the list in {"ornaments": [...]} or in [...]; nullptr in any other JSON.
template <typename AnyJson>
auto* list_in(AnyJson& json) {
  AnyJson* list =
      json.is_object() && json.size() == 1 && json.contains("ornaments") ? &json["ornaments"] : &json;
  return list->is_array() ? list : nullptr;
}

template <typename T>
Result<void> set(T& to, Result<T> from) {
  if (!from) return std::unexpected(std::move(from).error());
  to = std::move(from.value());
  return {};
}

// A cached font, which exists as long as any options refer to it. Options that name the same file must share
// one font object, because successive pictures must have equal options, and options are equal only if their
// font objects are the same.
struct KnownFont {
  std::int64_t changed_ns;
  std::weak_ptr<const FontFile> font;
};

Result<std::shared_ptr<const FontFile>> read_font(const std::string& path) {
  static Guarded<std::map<std::string, KnownFont>> guarded;
  return guarded.with([&](auto& fonts) -> Result<std::shared_ptr<const FontFile>> {
    const std::int64_t changed_ns = time_of_change_ns(path);
    if (const auto known = fonts.find(path); known != fonts.end() && known->second.changed_ns == changed_ns)
      if (auto font = known->second.font.lock()) return font;
    std::erase_if(fonts, [](const auto& each) { return each.second.font.expired(); });
    RELIEVO_TRY(std::vector<std::byte> bytes, read_file(path));
    auto font = std::make_shared<const FontFile>(path, std::move(bytes));
    fonts.insert_or_assign(path, KnownFont{changed_ns, font});
    return font;
  });
}

Result<std::shared_ptr<const FontFile>> font_of(const std::string& path, const std::string& folder,
                                                const OrnamentFiles& inside) {
  const auto found = inside.find(path);
  if (found == inside.end()) return read_font(path_in(folder, path));
  return std::make_shared<const FontFile>(path, found->second);
}

// Reads one list of ornaments. Errors name the key whose value is wrong.
class OrnamentReader {
 public:
  OrnamentReader(const std::string& name, const std::string& folder, const OrnamentFiles& inside)
      : name_(name), folder_(folder), inside_(inside) {}

  Result<std::vector<Ornament>> read(const Json& json) const {
    const Json* const list = list_in(json);
    if (!list || list->empty())
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
    if (key == "font") return set(to.font, font_of(text, folder_, inside_));
    if (key == "file") return read_drawing(text, to);
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

  Result<void> read_drawing(const std::string& file, Ornament& to) const {
    const auto found = inside_.find(file);
    const bool is_inside = found != inside_.end();
    const std::string path = is_inside ? file : path_in(folder_, file);
    RELIEVO_TRY(const std::vector<std::byte> bytes,
                is_inside ? Result<std::vector<std::byte>>(found->second) : read_file(path));
    return set(to.outlines, read_svg(text_in(bytes), path));
  }

  const std::string &name_, &folder_;
  const OrnamentFiles& inside_;
};

}  // namespace

Result<std::vector<Ornament>> parse_ornaments(std::string_view text, const std::string& name,
                                              const std::string& folder, const OrnamentFiles& inside) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded())
    return input_error(name, json_error_place(text),
                       "expected ornaments in JSON, found text that is no JSON");
  return OrnamentReader(name, folder, inside).read(json);
}

bool is_ornament_json(std::string_view value) {
  return value.starts_with('{') || value.starts_with('[');
}

void change_ornament_paths(std::string* font, std::string* ornaments,
                           const std::function<std::string(const std::string&)>& change) {
  if (font && !font->empty()) *font = change(*font);
  if (!ornaments || ornaments->empty()) return;
  if (!is_ornament_json(*ornaments)) {
    *ornaments = change(*ornaments);
    return;
  }
  auto json = nlohmann::ordered_json::parse(*ornaments, nullptr, false);
  auto* const list = list_in(json);
  if (!list) return;  // parse_ornaments() will report this error
  bool is_changed = false;
  for (auto& ornament : *list)
    for (const char* const key : {"font", "file"})
      if (ornament.is_object() && ornament.contains(key) && ornament[key].is_string()) {
        ornament[key] = change(ornament[key].get<std::string>());
        is_changed = true;
      }
  if (is_changed) *ornaments = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void change_ornament_paths(OptionValues& options,
                           const std::function<std::string(const std::string&)>& change) {
  const auto text_of = [&](const char* name) {
    const auto found = options.find(name);
    return found == options.end() ? nullptr : std::get_if<std::string>(&found->second);
  };
  change_ornament_paths(text_of("font"), text_of("ornaments"), change);
}

Result<void> read_ornaments(ReliefOptions& options, const OrnamentFiles& inside) {
  const std::string &font = options.font_name, &source = options.ornament_source;
  if (!font.empty()) RELIEVO_CHECK(set(options.font, font_of(font, {}, inside)));
  if (source.empty()) return {};
  if (is_ornament_json(source))
    return set(options.ornaments, parse_ornaments(source, "ornaments", {}, inside));
  if (!is_there(source))
    return option_error(
        "ornaments",
        cat("expected JSON such as [{\"kind\": \"beads\"}], or a file with it, found '", source, "'"));
  RELIEVO_TRY(const std::vector<std::byte> bytes, read_file(source));
  const std::string folder = std::filesystem::path(source).parent_path().string();
  return set(options.ornaments, parse_ornaments(text_in(bytes), source, folder));
}

}  // namespace relievo::app
