#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "files.h"
#include "relievo/frame.h"
#include "relievo/io.h"
#include "relievo/parallel.h"
#include "relievo/text.h"
#include "relievo/version.h"

namespace relievo::cli {
namespace {

struct BenchArguments {
  std::string input, view = "front", up;
  int frames = 60;
  bool is_json = false;
};

// Milliseconds of one part of a frame over many frames.
struct Series {
  std::vector<double> ms;

  double percentile(double share) {
    std::sort(ms.begin(), ms.end());
    return ms.empty() ? 0 : ms[static_cast<std::size_t>(share * static_cast<double>(ms.size() - 1) + .5)];
  }
};

struct FrameFigures {
  std::string mode;
  int threads = 1;
  Series heights, detail, normals, whole;
  double solves = 0;  // per frame
};

// Frames as a user drags a slider: the detail, or with a locked height the saturation.
FrameFigures measure_frames(const ReliefModel& model, int threads, int frames, bool is_locked) {
  set_thread_count(threads);
  FrameFigures figures{is_locked ? "exact, height locked" : "exact", threads, {}, {}, {}, {}, 0};
  FrameMaker maker(model);
  Frame frame;
  FrameOptions options;
  options.shape = {{.5, .01}, .04};
  maker.make(options, frame);
  if (is_locked) options.height = .8 * frame.height;
  if (is_locked) maker.make(options, frame);
  for (int i = 0; i < frames; ++i) {
    (is_locked ? options.shape.compression.beta : options.shape.gamma) += .001;
    maker.make(options, frame);
    const FrameTimes& t = frame.times;
    figures.heights.ms.push_back(1e3 * t.heights_s);
    figures.detail.ms.push_back(1e3 * t.detail_s);
    figures.normals.ms.push_back(1e3 * t.normals_s);
    figures.whole.ms.push_back(1e3 * (t.heights_s + t.detail_s + t.normals_s));
    figures.solves += static_cast<double>(t.solves) / frames;
  }
  return figures;
}

double peak_memory_mib() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

struct BenchResult {
  std::size_t input_points = 0, visible_points = 0;
  std::vector<StageTime> preparation;
  std::vector<FrameFigures> frames;
  double frame_bytes_per_point = 0;  // of the system and the packed frame data
};

Result<BenchResult> measure(const BenchArguments& arguments) {
  const Result<std::vector<std::byte>> bytes = read_file(arguments.input);
  if (!bytes) return std::unexpected(bytes.error());
  const Result<CloudFile> file = read_cloud(*bytes, arguments.input);
  if (!file) return std::unexpected(file.error());
  const Result<View> view = parse_view(arguments.view, arguments.up);
  if (!view) return std::unexpected(view.error());
  Progress progress;
  Result<Surface> surface = find_surface(file->cloud, *view, {}, &progress);
  if (!surface) return std::unexpected(surface.error());
  const Result<ReliefModel> model = ReliefModel::prepare(std::move(*surface), &progress);
  if (!model) return std::unexpected(model.error());
  progress.finish();

  BenchResult result{file->cloud.size(), model->surface().points.size(), progress.times(), {}, 0};
  const int most_threads = thread_count();
  for (const int threads : {1, most_threads})
    for (const bool is_locked : {false, true})
      if (threads == most_threads || !is_locked)
        result.frames.push_back(measure_frames(*model, threads, arguments.frames, is_locked));
  const FrameMaker maker(*model);
  result.frame_bytes_per_point = static_cast<double>(model->system().memory() + maker.memory()) /
                                 static_cast<double>(model->surface().points.size());
  return result;
}

void print_table(BenchResult& r) {
  std::printf("%zu points, %zu visible\n\npreparation, seconds\n", r.input_points, r.visible_points);
  for (const StageTime& stage : r.preparation)
    std::printf("  %-16s %7.3f\n", stage.name.c_str(), stage.seconds);
  std::printf("\nframes, milliseconds%-18s threads     t1     t2     t3    p50    p95  frames/s  solves\n",
              "");
  for (FrameFigures& f : r.frames)
    std::printf("  %-36s %7d %6.2f %6.2f %6.2f %6.2f %6.2f %9.1f %7.2f\n", f.mode.c_str(), f.threads,
                f.heights.percentile(.5), f.detail.percentile(.5), f.normals.percentile(.5),
                f.whole.percentile(.5), f.whole.percentile(.95), 1e3 / f.whole.percentile(.5), f.solves);
  std::printf("  paper's Table 1, 8,000 control points, six cores: 26 to 44 frames/s\n");
  std::printf("\nmemory: %.0f bytes per visible point for frames, peak %.0f MiB\n", r.frame_bytes_per_point,
              peak_memory_mib());
}

void print_json(BenchResult& r) {
  nlohmann::json preparation, frames = nlohmann::json::array();
  for (const StageTime& stage : r.preparation) preparation[stage.name] = stage.seconds;
  for (FrameFigures& f : r.frames)
    frames.push_back({{"mode", f.mode},
                      {"threads", f.threads},
                      {"t1_ms", f.heights.percentile(.5)},
                      {"t2_ms", f.detail.percentile(.5)},
                      {"t3_ms", f.normals.percentile(.5)},
                      {"p50_ms", f.whole.percentile(.5)},
                      {"p95_ms", f.whole.percentile(.95)},
                      {"solves", f.solves}});
  const nlohmann::json json{{"version", version},
                            {"input_points", r.input_points},
                            {"visible_points", r.visible_points},
                            {"preparation_s", preparation},
                            {"frames", frames},
                            {"frame_bytes_per_point", r.frame_bytes_per_point},
                            {"peak_mib", peak_memory_mib()}};
  std::printf("%s\n", json.dump(2).c_str());
}

Result<void> bench(const BenchArguments& arguments) {
  Result<BenchResult> result = measure(arguments);
  if (!result) return std::unexpected(result.error());
  arguments.is_json ? print_json(*result) : print_table(*result);
  return {};
}

}  // namespace

void add_bench(CLI::App& program, Result<void>& result) {
  const auto arguments = std::make_shared<BenchArguments>();
  CLI::App& command = *program.add_subcommand("bench", "Time preparation and frames of one scan");
  command.add_option("input", arguments->input, "point cloud: PLY, OBJ, XYZ, PTS")
      ->required()
      ->type_name("INPUT");
  command.add_option("--view", arguments->view, "as for make")->type_name("SIDE")->capture_default_str();
  command.add_option("--up", arguments->up, "as for make")->type_name("X,Y,Z");
  command.add_option("--frames", arguments->frames, "frames timed for each line [5 to 10000]")
      ->check(CLI::Range(5, 10000).description(""))
      ->type_name("N")
      ->capture_default_str();
  command.add_flag("--json", arguments->is_json, "print JSON instead of a table");
  command.callback([arguments, &result] { result = bench(*arguments); });
}

}  // namespace relievo::cli
