// Measures how long views take while a user turns a scan.
#include <unistd.h>

#include <Eigen/Geometry>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <limits>
#include <numbers>

#include "cli/frame_figures.h"
#include "relievo/relief/frame.h"
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
