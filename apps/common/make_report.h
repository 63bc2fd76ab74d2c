// The report on a relief, as JSON: of `relievo make` and of Python.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "relievo/core/length.h"
#include "relievo/core/progress.h"
#include "relievo/make_relief.h"
#include "relievo/scene.h"

namespace relievo::app {

// All that the report is on.
struct MakeOutcome {
  const MadeRelief& made;
  const nlohmann::json& models;  // see models_report()
  LengthUnit unit;               // of the solid's file
  std::span<const StageTime> times;
};

// Returns the models of the scene and their places: a point p of a file is scale * rotation * p + offset in the scene.
nlohmann::json models_report(const Scene& scene, const View& view);

// Returns the report, with numbers in millimetres.
nlohmann::json make_report(const MakeOutcome& outcome);

// Returns the report as the text of its file.
std::string report_text(const nlohmann::json& report);

// Returns the size of the solid's box.
Vec3 size_mm(const Solid& solid);

}  // namespace relievo::app
