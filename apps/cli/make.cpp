#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "files.h"
#include "relievo/io.h"
#include "relievo/make_relief.h"
#include "relievo/parallel.h"
#include "relievo/preview.h"
#include "relievo/text.h"
#include "relievo/version.h"
#include "terminal.h"

namespace relievo::cli {
namespace {

struct MakeArguments {
  std::string input, output, preview, heightmap, report;
  int heightmap_px = 1024;
  int threads = 0;
  bool is_quiet = false;
  ReliefOptions relief;
};

using SolidWriter = std::vector<std::byte> (*)(const Solid&);

const std::map<std::string, SolidWriter>& solid_writers() {
  static const std::map<std::string, SolidWriter> writers{
      {"stl", write_stl}, {"ply", write_ply}, {"obj", write_obj}};
  return writers;
}

// Each output has a place of its own that can be written to.
Result<void> check_places(const MakeArguments& arguments) {
  std::vector<std::string> taken{arguments.input};
  for (const std::string& path :
       {arguments.output, arguments.preview, arguments.heightmap, arguments.report}) {
    if (path.empty()) continue;
    if (auto ok = check_writable(path); !ok) return ok;
    for (const std::string& other : taken)
      if (is_same_file(path, other))
        return std::unexpected(
            Error{ErrorKind::option, path, {}, "expected different files for input and outputs"});
    taken.push_back(path);
  }
  return {};
}

Result<void> check_outputs(const MakeArguments& arguments) {
  if (!solid_writers().contains(ending_of(arguments.output)))
    return std::unexpected(
        Error{ErrorKind::option, arguments.output, {}, "expected a file ending in .stl, .ply or .obj"});
  for (const std::string& picture : {arguments.preview, arguments.heightmap})
    if (!picture.empty() && ending_of(picture) != "png")
      return std::unexpected(Error{ErrorKind::option, picture, {}, "expected a file ending in .png"});
  return check_places(arguments);
}

std::vector<std::byte> height_map_file(const Solid& solid, int longer_side_px) {
  const HeightMap map = make_height_map(solid, longer_side_px);
  const std::pair<std::string, std::string> scale[] = {{"mm_per_pixel", cat(map.mm_per_pixel)},
                                                       {"mm_per_grey", cat(map.mm_per_grey)}};
  return write_png(map.image, scale, map.mm_per_pixel);
}

nlohmann::json report_json(const ReliefReport& report, const Progress& progress) {
  const auto number_or_null = [](double x) {
    return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json();
  };
  nlohmann::json seconds = nlohmann::json::object();
  for (const StageTime& stage : progress.times()) seconds[stage.name] = stage.seconds;
  std::vector<double> rotation;
  for (int i = 0; i < 9; ++i) rotation.push_back(report.rotation(i / 3, i % 3));
  return {{"version", version},
          {"threads", thread_count()},
          {"input_points", report.input_points},
          {"visible_points", report.visible_points},
          {"rho", report.rho},
          {"diagonal", report.diagonal},
          {"method", report.method},
          {"alpha", number_or_null(report.alpha)},
          {"beta", report.beta},
          {"gamma", report.gamma},
          {"u", number_or_null(report.u)},
          {"height_requested_mm",
           report.height_requested_mm ? nlohmann::json(*report.height_requested_mm) : nlohmann::json()},
          {"height_mm", report.height_mm},
          {"below_ground_mm", report.below_ground_mm},
          {"seconds", seconds},
          {"model_to_mm",
           {{"rotation", rotation},
            {"scale", report.scale},
            {"offset", {report.offset.x(), report.offset.y(), report.offset.z()}}}},
          {"remarks", report.remarks}};
}

std::vector<std::byte> text_bytes(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

Result<CloudFile> load(const std::string& input, Progress& progress) {
  if (auto go = progress.stage("read", 0); !go) return std::unexpected(go.error());
  const Result<std::vector<std::byte>> bytes = read_file(input);
  if (!bytes) return std::unexpected(bytes.error());
  return read_cloud(*bytes, input);
}

// What was left out of a file, in a line for each, or nothing.
std::vector<std::string> remarks_on(const CloudFile& file, const std::string& input) {
  std::vector<std::string> lines;
  if (file.dropped_points > 0)
    lines.push_back(
        cat(input, ": left out ", file.dropped_points, " points with coordinates that are not finite"));
  if (file.dropped_normals > 0)
    lines.push_back(cat(input, ": left out ", file.dropped_normals,
                        file.cloud.has_normals() ? " points without a usable normal" : " unusable normals"));
  return lines;
}

std::vector<OutputFile> finished_files(const MakeArguments& arguments, const MadeRelief& made,
                                       Progress& progress) {
  std::vector<OutputFile> files;
  files.push_back({arguments.output, solid_writers().at(ending_of(arguments.output))(made.solid)});
  if (!arguments.heightmap.empty())
    files.push_back({arguments.heightmap, height_map_file(made.solid, arguments.heightmap_px)});
  if (!arguments.preview.empty())
    files.push_back({arguments.preview, write_png(render_preview(made.solid, {}))});
  progress.finish();
  if (!arguments.report.empty())
    files.push_back({arguments.report, text_bytes(report_json(made.report, progress).dump(2) + "\n")});
  return files;
}

// Every file in memory, and the lines to say about them.
struct Finished {
  std::vector<OutputFile> files;
  std::vector<std::string> lines;
};

Result<Finished> run(const MakeArguments& arguments, Progress& progress) {
  const Result<CloudFile> file = load(arguments.input, progress);
  if (!file) return std::unexpected(file.error());
  Finished finished{{}, remarks_on(*file, arguments.input)};
  Result<MadeRelief> made = make_relief(file->cloud, arguments.relief, &progress);
  if (!made) {
    if (made.error().input.empty()) made.error().input = arguments.input;
    return std::unexpected(made.error());
  }
  (void)progress.stage("files", .97);
  finished.files = finished_files(arguments, *made, progress);
  const ReliefReport& report = made->report;
  finished.lines.insert(finished.lines.end(), report.remarks.begin(), report.remarks.end());
  finished.lines.push_back(cat(arguments.output, ": ", report.visible_points, " of ", report.input_points,
                               " points, height ", report.height_mm, " mm, ", report.below_ground_mm,
                               " of it below the ground"));
  return finished;
}

Result<void> make(const MakeArguments& arguments) {
  if (auto ok = check(arguments.relief); !ok) return ok;
  if (auto ok = check_outputs(arguments); !ok) return ok;
  set_thread_count(arguments.threads);
  Progress progress(progress_bar(arguments.is_quiet));
  const Result<Finished> finished = run(arguments, progress);
  progress.finish();  // erases the bar, also before an error
  if (!finished) return std::unexpected(finished.error());
  if (auto ok = write_files(finished->files); !ok) return ok;
  for (const std::string& line : finished->lines)
    if (!arguments.is_quiet) std::fprintf(stderr, "%s\n", line.c_str());
  return {};
}

// Adds one flag for each field of ReliefOptions.
struct FlagAdder {
  CLI::App& command;

  void operator()(const OptionField& field, double& value) {
    describe(command.add_option(flag(field), value, help(field)), field)->capture_default_str();
  }
  void operator()(const OptionField& field, std::optional<double>& value) {
    describe(command.add_option(flag(field), value, help(field)), field);
  }
  void operator()(const OptionField& field, std::string& value) {
    CLI::Option* option = command.add_option(flag(field), value, std::string(field.help));
    describe(option, field)->capture_default_str();
  }

  static std::string flag(const OptionField& field) { return cat("--", field.name); }
  static std::string help(const OptionField& field) {
    return cat(field.help, " [", field.min, " to ", field.max, "]");
  }
  static CLI::Option* describe(CLI::Option* option, const OptionField& field) {
    return option->type_name(std::string(field.unit));
  }
};

}  // namespace

void add_make(CLI::App& program, Result<void>& result) {
  const auto arguments = std::make_shared<MakeArguments>();
  CLI::App& command = *program.add_subcommand("make", "Make a relief from a scan");
  command.add_option("input", arguments->input, "point cloud: PLY, OBJ, XYZ, PTS")
      ->required()
      ->type_name("INPUT");
  command.add_option("-o,--output", arguments->output, "the solid: .stl, .ply or .obj, in millimetres")
      ->required()
      ->type_name("OUT");
  command.add_option("--preview", arguments->preview, "picture of the relief")->type_name("P.png");
  command.add_option("--heightmap", arguments->heightmap, "16-bit height map of the front")
      ->type_name("H.png");
  command.add_option("--heightmap-size", arguments->heightmap_px, "its longer side [16 to 16384]")
      ->check(CLI::Range(16, 16384).description(""))
      ->type_name("PX")
      ->capture_default_str();
  FlagAdder adder{command};
  visit(arguments->relief, adder);
  command.add_option("--threads", arguments->threads, "0 for all [0 to 256]")
      ->check(CLI::Range(0, 256).description(""))
      ->type_name("N")
      ->capture_default_str();
  command.add_option("--report", arguments->report, "what was made and how, as JSON")->type_name("R.json");
  command.add_flag("--quiet", arguments->is_quiet, "print errors only");
  command.callback([arguments, &result] { result = make(*arguments); });
}

}  // namespace relievo::cli
