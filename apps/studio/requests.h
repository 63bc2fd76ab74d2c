// What the page and the engine tell each other, as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "engine.h"

namespace relievo::studio {

// A body of a request as JSON; errors of kind input for text that is none, or no object.
Result<nlohmann::json> parse_body(std::string_view body);

// Errors: kind input or option, naming the field.
Result<PictureRequest> picture_request(const nlohmann::json& json);
Result<Vec2> place_from(const nlohmann::json& json, const char* key);
Result<View> view_from(const nlohmann::json& json);

nlohmann::json to_json(const EngineStatus& status);
nlohmann::json to_json(const ModelFacts& facts);

// What comes with a picture's pixels.
nlohmann::json to_json(const PictureAnswer& answer);

// Name, unit, help and range of every option, with its default.
nlohmann::json option_list();

nlohmann::json error_json(const Error& error);

}  // namespace relievo::studio
