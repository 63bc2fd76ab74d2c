#include "web/npm/order.h"

#include <nlohmann/json.hpp>

#include "relievo/core/length.h"
#include "relievo/core/text.h"

namespace relievo::app::web {
namespace {

using Json = nlohmann::json;

// Takes the values of the fields of a table from an object; remembers the first error, and how many fields there were.
struct OptionReader {
  const Json& given;
  std::set<std::string>& taken;
  std::optional<Error> error = {};

  void operator()(const OptionField& field, double& value) {
    if (const std::optional<double> number = take_number(field)) value = *number;
  }
  void operator()(const OptionField& field, std::optional<double>& value) {
    if (const std::optional<double> number = take_number(field)) value = number;
  }
  void operator()(const OptionField& field, std::string& value) {
    const Json* const found = find(field);
    if (!found) return;
    if (found->is_string())
      value = found->get<std::string>();
    else
      fail(field, "expected a text");
  }

 private:
  const Json* find(const OptionField& field) {
    const auto found = given.find(field.name);
    if (found == given.end() || found->is_null()) return nullptr;
    taken.emplace(field.name);
    return &*found;
  }

  void fail(const OptionField& field, std::string expected) {
    if (!error) error = Error{ErrorKind::option, std::string(field.name), {}, std::move(expected)};
  }

  std::optional<double> take_number(const OptionField& field) {
    const Json* const found = find(field);
    if (!found) return std::nullopt;
    if (found->is_number()) return found->get<double>();
    const bool is_length = field.unit == "MM";
    const Result<double> length =
        is_length && found->is_string() ? parse_length(found->get<std::string>()) : Result<double>(0);
    if (is_length && found->is_string() && length) return *length;
    if (length)
      fail(field, is_length ? "expected a number or a length such as '4in'" : "expected a number");
    else
      fail(field, length.error().expected);
    return std::nullopt;
  }
};

std::string text_in(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace

Result<MakeOrder> order_from(const Json& json) {
  MakeOrder order;
  DepthTexts depth;
  const Json options = json.contains("options") ? json["options"] : Json::object();
  if (!options.is_object()) return option_error("options", "expected an object");
  OptionReader reader{options, order.given};
  visit(order.texts, reader);
  visit(depth, reader);
  if (reader.error) return std::unexpected(*reader.error);
  for (const auto& [key, value] : options.items())
    if (!value.is_null() && !order.given.contains(key))
      return option_error(key, "expected the name of an option");
  RELIEVO_TRY(order.in.depth, parse_depth(depth));
  order.in.camera = text_in(json, "camera");
  order.base_image_path = text_in(json, "base_image");
  order.scan_path = text_in(json, "scan");
  if (const auto mb = json.find("stream_above_mb"); mb != json.end() && mb->is_number())
    order.in.stream_above_mb = mb->get<double>();
  if (const auto inputs = json.find("inputs"); inputs != json.end() && inputs->is_array())
    for (const Json& path : *inputs)
      if (path.is_string()) order.inputs.push_back(path.get<std::string>());
  return order;
}

}  // namespace relievo::app::web
