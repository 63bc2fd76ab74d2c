#include "cli/frame_figures.h"

#include <unistd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <limits>
#include <numbers>

#include "relievo/core/parallel.h"
#include "relievo/relief/control_points.h"
#include "relievo/relief/frame.h"
#include "relievo/relief/subspace.h"
#include "relievo/scan/surface.h"
#include "relievo/session.h"

namespace relievo::app::cli {
namespace {

constexpr double step_deg = 4;  // angle between successive views

template <typename F>
Result<double> milliseconds(F&& work) {
  const auto start = std::chrono::steady_clock::now();
  RELIEVO_CHECK(work());
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

View turned(const View& view, int steps) {
  View other = view;
  const double angle = steps * step_deg * std::numbers::pi / 180;
  other.R_view_model = Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix() * view.R_view_model;
  return other;
}

void make_frame(const ReliefModel& model, double spacing_ratio) {
  FrameOptions options{Shape{}};
  options.shape.boundary_width *= spacing_ratio;
  Frame frame;
  FrameMaker(model).make(options, frame);
}

Result<void> prepare(Session& session, const ViewRun& run, const View& view) {
  Preparation preparation;
  preparation.points = [&](Progress&) -> Preparation::Points { return run.cloud; };
  preparation.view = view;
  preparation.model = {run.mode};
  session.open(std::move(preparation));
  while (!session.wait_until_idle(std::chrono::hours(1))) {
  }
  if (const auto error = session.status().error) return std::unexpected(*error);
  make_frame(*session.model(), 1);
  return {};
}

Result<void> turn(Session& session, const View& view) {
  RELIEVO_TRY(const ShownModel relief, session.turn(view));
  make_frame(*relief.model, relief.spacing_ratio);
  return {};
}

// Returns the memory that the process uses now, in MiB; 0 if the system does not report it.
double resident_mib() {
  long pages = 0;
  std::ifstream("/proc/self/statm").ignore(std::numeric_limits<std::streamsize>::max(), ' ') >> pages;
  return static_cast<double>(pages) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20);
}

// Measures one call of show() for each view of the run.
template <typename F>
Result<ViewSeries> measure_series(const ViewRun& run, F&& show) {
  ViewSeries series;
  for (int i = 1; i <= run.views; ++i) {
    RELIEVO_TRY(const double ms, milliseconds([&] { return show(turned(run.view, i)); }));
    series.time.ms.push_back(ms);
    if (i == (run.views + 9) / 10) series.early_mib = resident_mib();
  }
  series.late_mib = resident_mib();
  return series;
}

}  // namespace

double Series::percentile(double share) const {
  if (ms.empty()) return 0;
  std::vector<double> sorted = ms;
  std::sort(sorted.begin(), sorted.end());
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + .5)];
}

FrameFigures measure_frames(const ReliefModel& model, const FrameRun& run) {
  const int threads_before = thread_count();
  set_thread_count(run.threads);
  FrameFigures figures{.mode = model.control_points() > 0 ? "subspace" : "exact",
                       .visible_points = model.surface().points.size(),
                       .control_points = model.control_points(),
                       .threads = run.threads};
  if (model.paper()) figures.mode += ", paper";
  if (run.is_locked) figures.mode += ", height locked";
  if (run.is_ahead) figures.mode += ", one step ahead";
  FrameMaker maker(model);
  Frame frame;
  FrameOptions options;
  options.shape = {{.5, .01}, .04};
  options.shape.style = model.paper() ? Style::paper_weights : Style::layered;
  maker.make(options, frame);
  if (run.is_locked) options.height = .8 * frame.height;
  if (run.is_locked) maker.make(options, frame);
  for (int i = 0; run.is_ahead && i < 2; ++i) maker.make_ahead(options, frame);
  for (int i = 0; i < run.frames; ++i) {
    (run.is_locked ? options.shape.compression.beta : options.shape.gamma) += .001;
    const auto start = std::chrono::steady_clock::now();
    if (run.is_ahead)
      maker.make_ahead(options, frame);
    else
      maker.make(options, frame);
    const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - start;
    const FrameTimes& t = frame.times;
    figures.heights.ms.push_back(1e3 * t.heights_s);
    figures.detail.ms.push_back(1e3 * t.after_solve_s);
    figures.normals.ms.push_back(1e3 * t.normals_s);
    figures.whole.ms.push_back(1e3 * whole.count());
    figures.solves += static_cast<double>(t.solves) / run.frames;
  }
  set_thread_count(threads_before);
  return figures;
}

double bytes_per_point(const ReliefModel& model) {
  const FrameMaker maker(model);
  return static_cast<double>(model.memory() + maker.memory()) /
         static_cast<double>(model.surface().points.size());
}

void print_frame_head() {
  std::printf("%-30s %9s %8s %7s %6s %6s %6s %6s %6s %8s %6s\n", "frames, milliseconds", "visible", "control",
              "threads", "t1", "t2", "t3", "p50", "p95", "frames/s", "solves");
}

void print_frames(const FrameFigures& f) {
  const double p50 = f.whole.percentile(.5);
  std::printf("  %-28s %9zu %8zu %7d %6.2f %6.2f %6.2f %6.2f %6.2f %8.1f %6.2f\n", f.mode.c_str(),
              f.visible_points, f.control_points, f.threads, f.heights.percentile(.5),
              f.detail.percentile(.5), f.normals.percentile(.5), p50, f.whole.percentile(.95),
              p50 > 0 ? 1e3 / p50 : 0, f.solves);
}

void print_paper_rows() {
  std::printf("the paper's Table 1 (six cores; t1 to t3 of three frames at once)\n");
  for (const PaperRow& row : paper_table_1)
    std::printf("  %-28s %9d %8d %7d %6d %6d %6d %6s %6s %8.2f\n", row.model, row.visible_points,
                row.control_points, 6, row.t1, row.t2, row.t3, "", "", row.frames_per_second);
}

Result<ViewFigures> measure_views(const ViewRun& run) {
  Session session;
  ViewFigures figures;
  RELIEVO_TRY(figures.first_ms, milliseconds([&] { return prepare(session, run, run.view); }));
  RELIEVO_TRY(figures.first_turned_ms, milliseconds([&] { return turn(session, run.view); }));
  RELIEVO_TRY(figures.turned, measure_series(run, [&](const View& view) { return turn(session, view); }));
  RELIEVO_TRY(figures.prepared,
              measure_series(run, [&](const View& view) { return prepare(session, run, view); }));
  return figures;
}

void print_views(const ViewFigures& f) {
  const auto time = [](const char* name, const Series& series) {
    std::printf("  %-28s %7.1f %7.1f", name, series.percentile(.5), series.percentile(.95));
  };
  const auto line = [&](const char* name, const ViewSeries& series) {
    time(name, series.time);
    std::printf(" %15.1f %7.1f\n", series.early_mib, series.late_mib);
  };
  std::printf("\n%-30s %15s %23s\n", "views with their first frames", "milliseconds", "MiB of the process");
  std::printf("%-30s %7s %7s %15s %7s\n", "", "p50", "p95", "after a tenth", "all");
  time("first", {{f.first_ms}});
  std::printf("\n");
  time("first while it is turned", {{f.first_turned_ms}});
  std::printf("\n");
  line("others while it is turned", f.turned);
  line("others", f.prepared);
}

}  // namespace relievo::app::cli
