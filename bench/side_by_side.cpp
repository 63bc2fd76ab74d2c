// Frames of one cloud by Relievo and by the paper's pipeline from stock parts, in one run, in the shape of
// the paper's Table 1: side_by_side INPUT [SIDE]
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "cli/frame_figures.h"
#include "relievo/core/parallel.h"
#include "relievo/io/read.h"
#include "relievo/relief/subspace.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scan/surface.h"
#include "stock_pipeline.h"

namespace relievo {
namespace {

constexpr int frames = 40;

Result<Surface> surface_of(const std::string& path, const std::string& side) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const Result<CloudFile> read = read_cloud(std::as_bytes(std::span(text)), path);
  if (!read) return std::unexpected(read.error());
  const Result<View> view = parse_view(side, "");
  if (!view) return std::unexpected(view.error());
  return find_surface(read->cloud, *view);
}

app::cli::FrameFigures measure_stock(StockPipeline& pipeline, std::string name, std::size_t control_points) {
  app::cli::FrameFigures figures{std::move(name), control_points, 1, {}, {}, {}, {}, 1};
  Shape shape{{.5, .01}, .04};
  for (int i = 0; i < frames; ++i, shape.gamma += .001) {
    const auto [t1, t2, t3] = pipeline.make(shape);
    figures.heights.ms.push_back(t1);
    figures.detail.ms.push_back(t2);
    figures.normals.ms.push_back(t3);
    figures.whole.ms.push_back(t1 + t2 + t3);
  }
  return figures;
}

// Prints our own, in the paper's style and in the default one, with all threads. Returns their control points.
Result<ControlPoints> print_ours(const Surface& surface) {
  const int threads = thread_count();
  ControlPoints control;
  for (const Mode mode : {Mode::exact, Mode::subspace}) {
    const Result<ReliefModel> model = ReliefModel::prepare(surface, nullptr, mode);
    if (!model) return std::unexpected(model.error());
    for (const Style style : {Style::paper, Style::layered})
      app::cli::print_frames(app::cli::measure_frames(*model, {threads, frames, false, style}),
                             surface.points.size());
    if (model->subspace()) control = model->subspace()->control_points();
  }
  return control;
}

Result<void> run(const std::string& path, const std::string& side) {
  const Result<Surface> surface = surface_of(path, side);
  if (!surface) return std::unexpected(surface.error());
  const std::size_t n = surface->points.size();
  std::printf("%s\n", path.c_str());
  app::cli::print_frame_head();
  const Result<ControlPoints> control = print_ours(*surface);
  if (!control) return std::unexpected(control.error());
  StockPipeline subspace(*surface, *control), exact(*surface);
  const std::size_t m = control->points.size();
  app::cli::print_frames(measure_stock(subspace, "stock parts, control points", m), n);
  app::cli::print_frames(measure_stock(exact, "stock parts, all points", 0), n);
  app::cli::print_paper_rows();
  return {};
}

}  // namespace
}  // namespace relievo

int main(int count, char** arguments) {
  if (count < 2) return std::fputs("usage: side_by_side INPUT [SIDE]\n", stderr), 2;
  const auto done = relievo::run(arguments[1], count > 2 ? arguments[2] : "front");
  if (!done) return std::fprintf(stderr, "%s\n", done.error().message().c_str()), 1;
}
