#include "common/option_list.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "relievo/core/text.h"

namespace relievo::app {
namespace {

using Json = nlohmann::json;

// Returns the default of a number: one value if all methods except the baselines have the same default, otherwise
// an object with one value per method.
Json number_by_method(const OptionRow& option) {
  Json by_method = Json::object();
  bool is_same = true;
  ReliefOptions options;
  for (const MethodInfo& info : methods) {
    if (!has_shape(info.method)) continue;
    options.method = info.method;
    const std::optional<double> value = option.access.number(options);
    if (!value) return {};
    is_same &= by_method.empty() || by_method.front() == *value;
    by_method[std::string(info.name)] = *value;
  }
  return is_same ? by_method.front() : by_method;
}

Json default_of(const OptionRow& option) {
  if (option.access.number) return number_by_method(option);
  return std::visit([](const auto& value) { return Json(value); }, option.initial);
}

// Returns an object with the defaults that replace the usual default of a number in special cases. Its keys
// are names of forms, and "diameter" for the case that a diameter is given.
Json other_defaults(const OptionRow& option) {
  Json others = Json::object();
  const ReliefOptions plain;
  const std::optional<double> usual = option.access.number ? option.access.number(plain) : std::nullopt;
  if (!usual) return others;
  const auto compare = [&](std::string_view name, const ReliefOptions& with) {
    if (const auto value = option.access.number(with); value != usual) others[std::string(name)] = *value;
  };
  ReliefOptions with;
  for (const auto& [name, form] : form_choices) with.form = form, compare(name, with);
  with = plain;
  with.diameter_mm = with.effective_width_mm();
  compare("diameter", with);
  return others;
}

std::string plain_text(const Json& value) {
  return value.is_string() ? value.get<std::string>() : cat(value.get<double>());
}

Json entry_of(const OptionRow& option) {
  Json entry{{"name", option.name},
             {"unit", option.unit},
             {"help", option.help},
             {"stage", name_in(option_stages, option.stage)}};
  if (option.is_number()) entry.update({{"min", option.min}, {"max", option.max}});
  if (!option.choices.empty()) entry["choices"] = option.choices;
  if (const Json value = default_of(option); !value.is_null()) entry["default"] = value;
  if (const Json others = other_defaults(option); !others.empty()) entry["default_with"] = others;
  if (!option.in_studio.empty()) entry["in_studio"] = option.in_studio;
  if (option.is_stated) entry["is_stated"] = true;
  if (option.is_hidden) entry["is_hidden"] = true;
  return entry;
}

}  // namespace

std::string default_text(const OptionRow& option) {
  if (!option.otherwise.empty()) return std::string(option.otherwise);
  const Json value = default_of(option);
  if (!value.is_object()) return plain_text(value);
  std::string text;
  for (const auto& [method, number] : value.items())
    text += cat(text.empty() ? "" : ", ", plain_text(number), " with method ", method);
  return text;
}

std::string help_text(const OptionRow& option) {
  if (option.is_number()) return cat(option.help, " [", option.min, " to ", option.max, "]");
  return option.choices.empty() ? std::string(option.help) : cat(option.help, "; ", either(option.choices));
}

Json option_list() {
  Json list = Json::array();
  for (const OptionRow& option : option_table()) list.push_back(entry_of(option));
  return list;
}

std::string keyword_of(const OptionRow& option) {
  std::string keyword(option.name);
  std::ranges::replace(keyword, '-', '_');
  if (option.is_length()) return keyword + "_mm";
  return option.unit == "DEG" ? keyword + "_deg" : keyword;
}

Json keyword_list() {
  Json list = Json::array();
  for (const OptionRow& option : option_table()) {
    Json& entry = list.emplace_back(entry_of(option));
    entry.update({{"keyword", keyword_of(option)}, {"default_text", default_text(option)}});
  }
  return list;
}

std::string option_markdown() {
  std::string text = "| flag | meaning | default |\n| --- | --- | --- |\n";
  for (const OptionRow& option : option_table())
    if (option.is_of_relief())
      text += cat("| `--", option.name, " ", option.unit, "` | ", help_text(option), " | ",
                  default_text(option), " |\n");
  return text;
}

}  // namespace relievo::app
