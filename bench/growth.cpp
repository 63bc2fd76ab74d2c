// Measures preparation, frames and memory on one generated shape that is scanned ever more densely, and the exponent of
// their growth with the number of visible points. Usage: growth [LARGEST, in thousands of visible points]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "cli/frame_figures.h"
#include "relievo/core/parallel.h"
#include "relievo/core/progress.h"
#include "relievo/samples/sample.h"
#include "relievo/scan/surface.h"

namespace relievo {
namespace {

struct Measured {
  double points = 0, preparation_s = 0, frame_ms = 0, locked_ms = 0, mib = 0;
};

Result<Measured> measure(std::size_t visible) {
  // The side shown has 2 of 5 points.
  const Result<Cloud> cloud = make_sample("shell", {visible * 5 / 2});
  if (!cloud) return std::unexpected(cloud.error());
  Progress progress;
  Result<Surface> surface = find_surface(*cloud, {}, &progress);
  if (!surface) return std::unexpected(surface.error());
  const Result<ReliefModel> model = ReliefModel::prepare(std::move(*surface), &progress);
  if (!model) return std::unexpected(model.error());
  progress.finish();

  Measured m{static_cast<double>(model->surface().points.size())};
  for (const StageTime& stage : progress.times()) m.preparation_s += stage.seconds;
  const int threads = thread_count();
  m.frame_ms = app::cli::measure_frames(*model, {threads, 30, false}).whole.percentile(.5);
  m.locked_ms = app::cli::measure_frames(*model, {threads, 30, true}).whole.percentile(.5);
  m.mib = app::cli::bytes_per_point(*model) * m.points / 1048576;
  return m;
}

// Least squares of log y = c + exponent log n.
double exponent(const std::vector<Measured>& all, double Measured::*y) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const Measured& m : all) {
    const double x = std::log(m.points), v = std::log(m.*y);
    sx += x, sy += v, sxx += x * x, sxy += x * v;
  }
  const auto n = static_cast<double>(all.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

Result<void> run(std::size_t largest) {
  std::printf("%10s %14s %12s %12s %10s\n", "visible", "preparation s", "frame ms", "locked ms", "MiB");
  std::vector<Measured> all;
  for (std::size_t visible = 50'000; visible <= largest; visible *= 2) {
    const Result<Measured> m = measure(visible);
    if (!m) return std::unexpected(m.error());
    std::printf("%10.0f %14.2f %12.2f %12.2f %10.0f\n", m->points, m->preparation_s, m->frame_ms,
                m->locked_ms, m->mib);
    std::fflush(stdout);
    all.push_back(*m);
  }
  std::printf("%10s %14.2f %12.2f %12.2f %10.2f\n", "exponent", exponent(all, &Measured::preparation_s),
              exponent(all, &Measured::frame_ms), exponent(all, &Measured::locked_ms),
              exponent(all, &Measured::mib));
  return {};
}

}  // namespace
}  // namespace relievo

int main(int count, char** arguments) {
  const std::size_t thousands = count > 1 ? std::strtoul(arguments[1], nullptr, 10) : 2000;
  const auto done = relievo::run(thousands * 1000);
  if (!done) return std::fprintf(stderr, "%s\n", done.error().message().c_str()), 1;
}
