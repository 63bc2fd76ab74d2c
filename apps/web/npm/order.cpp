#include "web/npm/order.h"

#include <nlohmann/json.hpp>

#include "relievo/core/text.h"

namespace relievo::app::web {
namespace {

using Json = nlohmann::json;

std::string text_in(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace

Result<MakeOrder> order_from(const Json& json) {
  MakeOrder order;
  const Json options = json.contains("options") ? json["options"] : Json::object();
  if (!options.is_object()) return option_error("options", "expected an object");
  for (const auto& [name, given] : options.items()) {
    if (given.is_null()) continue;
    const OptionRow* const option = find_option(name);
    if (!option) return option_error(name, "expected the name of an option");
    const std::optional<OptionValue> value = value_from_json(given);
    if (!value) return option_error(name, std::string(expected_type(*option)));
    order.values.emplace(name, *value);
  }
  RELIEVO_TRY(order.in.depth, parse_depth(order.values));
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
