// Reads the page's requests from JSON, and writes the engine's answers as JSON. Tested by
// apps/studio/tests/server.test.mjs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "common/export_file.h"
#include "studio/engine.h"

namespace relievo::app::studio {

// Returns the body of a request as JSON. Errors: kind input if it is not a JSON object.
Result<nlohmann::json> parse_body(std::string_view body);

// Read fields of a request. Errors: kind input or option; they name the field.
Result<PictureRequest> picture_request(const nlohmann::json& json);
Result<Vec2> place_from(const nlohmann::json& json, const char* key);
Result<std::vector<Vec2>> places_from(const nlohmann::json& json);
Result<View> view_from(const nlohmann::json& json);

// Reads the order for an export: the options of a height map and the material of a picture.
Result<ExportOrder> export_order_from(const nlohmann::json& json);

// Returns the options for preparing a scan. Options that the page did not send have their defaults.
OptionValues view_values(const nlohmann::json& json);

// Returns the options for preparing the scan of a new document.
OptionValues first_view();

nlohmann::json to_json(const EngineStatus& status);
nlohmann::json to_json(const ModelFacts& facts);

// Returns the facts that are sent with a picture's pixels.
nlohmann::json to_json(const PictureAnswer& answer);
nlohmann::json to_json(const OrnamentPlace& place);

// Returns the six sides: their names, the directions towards the viewer, and the directions that are shown
// upwards.
nlohmann::json view_list();

// Returns the materials of pictures: their ids, and their names for users.
nlohmann::json material_list();

nlohmann::json error_json(const Error& error);

}  // namespace relievo::app::studio
