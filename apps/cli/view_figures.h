// Measures how long a user waits who opens a scan and turns it.
#pragma once

#include <memory>

#include "cli/frame_figures.h"
#include "relievo/core/error.h"
#include "relievo/relief/method.h"
#include "relievo/scan/view.h"

namespace relievo::app::cli {

struct ViewRun {
  std::shared_ptr<const Cloud> cloud;
  View view;  // the first
  Mode mode = Mode::automatic;
  int views = 5;
};

// Views of one kind, one after the other.
struct ViewSeries {
  Series time;
  double early_mib = 0, late_mib = 0;  // memory of the process after a tenth of the views, and after all
};

struct ViewFigures {
  double first_ms = 0;         // from points in memory to the first frame of the first view
  double first_turned_ms = 0;  // from the first view to the first frame of a coarse relief
  ViewSeries turned;           // coarse reliefs with a frame of each
  ViewSeries prepared;         // other views with their first frames
};

// Opens the cloud in a session and turns it about the upright axis. Errors: those of preparations.
Result<ViewFigures> measure_views(const ViewRun& run);

void print_views(const ViewFigures& figures);

}  // namespace relievo::app::cli
