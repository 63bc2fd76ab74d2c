#include <sys/resource.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/commands.h"
#include "cli/flags.h"
#include "cli/frame_figures.h"
#include "common/files.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"
#include "relievo/make_relief.h"
#include "relievo/relief/relief.h"
#include "relievo/scan/surface.h"

namespace relievo::app::cli {
namespace {

struct BenchArguments {
  SceneArguments scene;
  std::string mode = "all";
  int frames = 60, views = 5;
  bool is_json = false;
};

double peak_memory_mib() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

struct BenchResult {
  std::size_t input_points = 0, visible_points = 0;
  std::vector<StageTime> preparation;
  std::vector<FrameFigures> frames;
  struct Memory {
    std::string mode;
    double bytes_per_point = 0;
  };
  std::vector<Memory> memory;
  std::optional<ViewFigures> views;
};

// Prepares a model with `make_model` and measures its frames: first with one thread, then with all threads.
template <typename F>
Result<void> measure_model(const std::string& name, int frames, F&& make_model, BenchResult& result) {
  Progress progress;
  RELIEVO_TRY(const ReliefModel model, make_model(&progress));
  progress.finish();
  for (const StageTime& stage : progress.times())
    result.preparation.push_back({cat(name, ": ", stage.name), stage.seconds});
  const int most_threads = thread_count();
  if (most_threads > 1) result.frames.push_back(measure_frames(model, {1, frames, false}));
  for (const bool is_locked : {false, true})
    result.frames.push_back(measure_frames(model, {most_threads, frames, is_locked}));
  if (model.paper()) result.frames.push_back(measure_frames(model, {most_threads, frames, false, true}));
  result.memory.push_back({name, bytes_per_point(model)});
  return {};
}

Result<std::vector<Mode>> modes_of(const BenchArguments& arguments, const Surface& surface) {
  if (arguments.mode == "all") return std::vector{Mode::exact, Mode::subspace};
  RELIEVO_TRY(const Mode mode, parse_choice("mode", arguments.mode, mode_choices));
  return std::vector{resolve_mode(mode, surface)};
}

Result<BenchResult> measure(const BenchArguments& arguments) {
  Progress progress;
  RELIEVO_TRY(const SampledView seen, read_sample(arguments.scene, &progress));
  RELIEVO_TRY(const Surface surface, find_surface(*seen.sample.cloud, seen.view, &progress));
  progress.finish();

  BenchResult result{surface.input_points, surface.points.size(), progress.times(), {}, {}, {}};
  RELIEVO_TRY(const std::vector<Mode> modes, modes_of(arguments, surface));
  for (const Mode mode : modes) {
    const std::string name = mode == Mode::exact ? "exact" : "subspace";
    RELIEVO_CHECK(measure_model(
        name, arguments.frames,
        [&](Progress* stages) { return ReliefModel::prepare(surface, stages, {mode}); }, result));
    RELIEVO_CHECK(measure_model(
        name + ", paper", arguments.frames,
        [&](Progress* stages) { return prepare(*seen.sample.cloud, seen.view.for_paper(), {mode}, stages); },
        result));
  }
  if (arguments.views == 0) return result;
  RELIEVO_TRY(result.views, measure_views({seen.sample.cloud, seen.view, modes.front(), arguments.views}));
  return result;
}

void print_table(const BenchResult& r) {
  std::printf("%zu points, %zu visible\n\npreparation, seconds\n", r.input_points, r.visible_points);
  for (const StageTime& stage : r.preparation)
    std::printf("  %-28s %7.3f\n", stage.name.c_str(), stage.seconds);
  std::printf("\n");
  print_frame_head();
  for (const FrameFigures& f : r.frames) print_frames(f);
  print_paper_rows();
  if (r.views) print_views(*r.views);
  std::printf("\nmemory after preparation, bytes per visible point\n");
  for (const auto& [mode, bytes] : r.memory) std::printf("  %-28s %7.0f\n", mode.c_str(), bytes);
  std::printf("peak of the whole run: %.0f MiB\n", peak_memory_mib());
}

void print_json(const BenchResult& r) {
  nlohmann::json preparation, frames = nlohmann::json::array(), paper, memory;
  for (const PaperRow& row : paper_table_1)
    paper.push_back(
        {row.model, row.visible_points, row.control_points, row.t1, row.t2, row.t3, row.frames_per_second});
  for (const StageTime& stage : r.preparation) preparation[stage.name] = stage.seconds;
  for (const auto& [mode, bytes] : r.memory) memory[mode] = bytes;
  for (const FrameFigures& f : r.frames)
    frames.push_back({{"mode", f.mode},
                      {"visible_points", f.visible_points},
                      {"control_points", f.control_points},
                      {"threads", f.threads},
                      {"t1_ms", f.heights.percentile(.5)},
                      {"t2_ms", f.detail.percentile(.5)},
                      {"t3_ms", f.normals.percentile(.5)},
                      {"p50_ms", f.whole.percentile(.5)},
                      {"p95_ms", f.whole.percentile(.95)},
                      {"solves", f.solves}});
  nlohmann::json json{{"version", version},
                      {"input_points", r.input_points},
                      {"visible_points", r.visible_points},
                      {"preparation_s", preparation},
                      {"frames", frames},
                      {"paper_table_1", paper},
                      {"bytes_per_point", memory},
                      {"peak_mib", peak_memory_mib()}};
  if (r.views) {
    json["views_ms"] = {{"first", r.views->first_ms},
                        {"first_turned", r.views->first_turned_ms},
                        {"turned_p50", r.views->turned.time.percentile(.5)},
                        {"turned_p95", r.views->turned.time.percentile(.95)},
                        {"prepared_p50", r.views->prepared.time.percentile(.5)},
                        {"prepared_p95", r.views->prepared.time.percentile(.95)}};
    json["views_mib"] = {{"turned", {r.views->turned.early_mib, r.views->turned.late_mib}},
                         {"prepared", {r.views->prepared.early_mib, r.views->prepared.late_mib}}};
  }
  std::printf("%s\n", json.dump(2).c_str());
}

Result<void> bench(const BenchArguments& arguments) {
  RELIEVO_TRY(const BenchResult result, measure(arguments));
  arguments.is_json ? print_json(result) : print_table(result);
  return {};
}

}  // namespace

void add_bench(CLI::App& program, Result<void>& result) {
  const auto arguments = std::make_shared<BenchArguments>();
  CLI::App& command = *program.add_subcommand("bench", "Time preparation and frames of one scan");
  add_scene_flags(command, arguments->scene);
  command.add_option("--mode", arguments->mode, "exact, subspace, auto or all")
      ->type_name("MODE")
      ->capture_default_str();
  add_number(command, "--frames", arguments->frames, CLI::Range(5, 10000),
             "frames timed for each line [5 to 10000]");
  add_number(command, "--views", arguments->views, CLI::Range(0, 10000),
             "other views timed; 0 times no views [0 to 10000]");
  command.add_flag("--json", arguments->is_json, "print JSON instead of a table");
  command.callback([arguments, &result] { result = bench(*arguments); });
}

}  // namespace relievo::app::cli
