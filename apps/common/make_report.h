// The report on a relief, as JSON, which FinishedRelief::report() returns.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "relievo/plate/solid.h"
#include "relievo/scene.h"

namespace relievo::app {

// Returns the models of the scene and their places: a point p of a file is scale * rotation * p + offset in the scene.
nlohmann::json models_report(const Scene& scene, const View& view);

// Returns the report as the text of its file.
std::string report_text(const nlohmann::json& report);

// Returns the size of the solid's box.
Vec3 size_mm(const Solid& solid);

}  // namespace relievo::app
