// The report of `relievo make`, as JSON.
#pragma once

#include <string>

#include "relievo/core/length.h"
#include "relievo/core/progress.h"
#include "relievo/make_relief.h"
#include "relievo/scene.h"

namespace relievo::app::cli {

// All that the report is on.
struct MakeOutcome {
  const MadeRelief& made;
  const Scene& scene;
  const View& view;
  LengthUnit unit;  // of the solid's file
  const Progress& progress;
};

// Returns the report as text, with numbers in millimetres.
std::string make_report(const MakeOutcome& outcome);

// Returns the size of the solid's box.
Vec3 size_mm(const Solid& solid);

}  // namespace relievo::app::cli
