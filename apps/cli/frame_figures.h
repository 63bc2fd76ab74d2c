// Measures the time and the memory of frames, and how long a user waits for a view while turning a scan.
// Prints the results beside the times in the paper.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/relief/relief.h"
#include "relievo/scan/view.h"

namespace relievo::app::cli {

// The durations of one part of the work for a frame. There is one duration for each measured frame.
struct Series {
  std::vector<double> ms = {};

  double percentile(double share) const;
};

struct FrameFigures {
  std::string mode;
  std::size_t visible_points = 0;
  std::size_t control_points = 0;  // 0: heights are solved for all visible points
  int threads = 1;
  Series heights = {}, detail = {}, normals = {}, whole = {};  // t1, t2, t3 of the paper; the whole frame
  double solves = 0;                                           // linear systems solved per frame
};

struct FrameRun {
  int threads = 1;
  int frames = 60;
  bool is_locked = false;  // whether the relief's height stays fixed
  bool is_ahead = false;   // whether FrameMaker::make_ahead() is used
};

// Makes frames as if a user dragged a slider, and measures them. The slider is that of the saturation if the
// height is locked, otherwise that of the detail.
FrameFigures measure_frames(const ReliefModel& model, const FrameRun& run);

// Returns the memory of a model and its frame maker, in bytes per visible point.
double bytes_per_point(const ReliefModel& model);

// A row of the paper's Table 1: times in milliseconds on six cores. The times t1, t2 and t3 overlap, because
// the paper's program computes three frames at the same time.
struct PaperRow {
  const char* model;
  int visible_points, control_points, t1, t2, t3;
  double frames_per_second;
};
inline constexpr std::array<PaperRow, 15> paper_table_1{{
    {"children", 636699, 7813, 19, 35, 48, 26.28},
    {"bust", 104543, 7924, 17, 26, 7, 38.38},
    {"eagle", 388646, 7913, 18, 33, 27, 30.16},
    {"lion", 178120, 6322, 14, 22, 10, 44.47},
    {"armadillo", 320108, 8129, 20, 32, 25, 31.70},
    {"squirrel", 99331, 6747, 15, 23, 7, 44.29},
    {"horse", 184202, 10045, 23, 35, 18, 28.51},
    {"bimba", 198457, 7469, 16, 26, 13, 36.39},
    {"dragon", 282472, 8669, 21, 30, 21, 33.14},
    {"models (12.a)", 328846, 10755, 25, 38, 21, 26.18},
    {"models (12.b)", 416327, 9021, 22, 38, 28, 26.55},
    {"frog", 168171, 7664, 17, 27, 12, 36.66},
    {"turtle", 181220, 8111, 17, 28, 12, 35.34},
    {"beckham", 346606, 8089, 18, 33, 24, 30.33},
    {"buddha", 173336, 7314, 17, 26, 11, 38.35},
}};

// Print a table like the paper's: its heading, a row of measured times, and the rows from the paper.
void print_frame_head();
void print_frames(const FrameFigures& figures);
void print_paper_rows();

struct ViewRun {
  std::shared_ptr<const Cloud> cloud;
  View view;  // the first view
  Mode mode = Mode::automatic;
  int views = 5;
};

// The times of successive views of one kind.
struct ViewSeries {
  Series time;
  double early_mib = 0, late_mib = 0;  // memory of the process after a tenth of the views, and after all
};

struct ViewFigures {
  double first_ms = 0;         // time from when the points are in memory to the first view's first frame
  double first_turned_ms = 0;  // time from the first view to the first frame of a turned relief
  ViewSeries turned;           // turned reliefs (see the glossary), with one frame each
  ViewSeries prepared;         // fully prepared views, with one frame each
};

// Opens the cloud in a session, turns it about the vertical axis, and measures the views. Errors: those of
// Session::turn() and of the session's preparations.
Result<ViewFigures> measure_views(const ViewRun& run);

void print_views(const ViewFigures& figures);

}  // namespace relievo::app::cli
