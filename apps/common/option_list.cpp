#include "common/option_list.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "relievo/core/text.h"
#include "relievo/scan/depth_image.h"

namespace relievo::app {
namespace {

using Json = nlohmann::json;

bool is_number(const ReliefField& field) {
  return !std::holds_alternative<std::string OptionTexts::*>(field.value);
}

// Returns the default of an option for each method that has a shape.
Json effective_default(const ReliefField& field) {
  Json by_method = Json::object();
  bool is_same = true;
  ReliefOptions options;
  for (const MethodInfo& info : methods) {
    if (!has_shape(info.method)) continue;
    options.method = info.method;
    const double value = field.effective(options);
    is_same &= by_method.empty() || by_method.front() == value;
    by_method[std::string(info.name)] = value;
  }
  return is_same ? by_method.front() : by_method;
}

// Null where nothing that has a value rules.
Json default_of(const ReliefField& field) {
  if (field.effective) return effective_default(field);
  const OptionTexts defaults;
  return std::visit(
      [&]<typename M>(const M member) -> Json {
        if constexpr (std::is_same_v<M, std::optional<double> NumericOptions::*>)
          return {};
        else
          return defaults.*member;
      },
      field.value);
}

std::string plain(const Json& value) {
  return value.is_string() ? value.get<std::string>() : cat(value.get<double>());
}

std::string range_text(const ReliefField& field) {
  return is_number(field) ? cat(" [", field.min, " to ", field.max, "]") : std::string();
}

}  // namespace

std::string default_text(const ReliefField& field) {
  if (!field.otherwise.empty()) return std::string(field.otherwise);
  const Json value = default_of(field);
  if (!value.is_object()) return plain(value);
  std::string text;
  for (const auto& [method, number] : value.items())
    text += cat(text.empty() ? "" : ", ", plain(number), " with method ", method);
  return text;
}

std::string help_text(const OptionField& field) {
  return field.choices.empty() ? std::string(field.help) : cat(field.help, "; ", either(field.choices));
}

Json option_list() {
  Json list = Json::array();
  for (const ReliefField& field : option_fields()) {
    Json entry{{"name", field.name}, {"unit", field.unit}, {"help", field.help}};
    if (is_number(field)) entry.update({{"min", field.min}, {"max", field.max}});
    if (!field.choices.empty()) entry["choices"] = field.choices;
    if (const Json value = default_of(field); !value.is_null()) entry["default"] = value;
    list.push_back(entry);
  }
  return list;
}

std::string keyword_of(const OptionField& field) {
  std::string keyword(field.name);
  std::ranges::replace(keyword, '-', '_');
  if (field.unit == "MM") return keyword + "_mm";
  return field.unit == "DEG" ? keyword + "_deg" : keyword;
}

Json keyword_list() {
  Json list = option_list();
  std::size_t i = 0;
  for (const ReliefField& field : option_fields()) {
    list[i]["keyword"] = keyword_of(field);
    list[i++]["default_text"] = default_text(field);
  }
  const DepthTexts depth;
  visit(depth, [&](const OptionField& field, const auto& value) {
    Json entry{{"keyword", keyword_of(field)}, {"name", field.name},    {"unit", field.unit},
               {"help", field.help},           {"default_text", value}, {"default", value}};
    if (!field.choices.empty()) entry["choices"] = field.choices;
    entry["is_of_input"] = true;
    list.push_back(entry);
  });
  return list;
}

std::string option_markdown() {
  std::string text = "| flag | meaning | default |\n| --- | --- | --- |\n";
  for (const ReliefField& field : option_fields())
    text += cat("| `--", field.name, " ", field.unit, "` | ", help_text(field), range_text(field), " | ",
                default_text(field), " |\n");
  return text;
}

}  // namespace relievo::app
