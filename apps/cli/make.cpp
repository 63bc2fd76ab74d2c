#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

#include "cli/commands.h"
#include "cli/flags.h"
#include "cli/terminal.h"
#include "common/export_file.h"
#include "common/files.h"
#include "common/input_files.h"
#include "common/make_order.h"
#include "common/relief_files.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/io/read.h"

namespace relievo::app::cli {
namespace {

struct MakeArguments : MakeOptions {
  std::string output;
  int threads = 0;
  bool is_quiet = false;
};

constexpr std::array<std::string_view, 3> map_endings{".png", ".tif", ".tiff"};

std::vector<std::string_view> output_endings() {
  std::vector<std::string_view> endings = solid_endings();
  endings.insert(endings.end(), map_endings.begin(), map_endings.end());
  return endings;
}

// Stores the path of --output. If it has the ending of a picture, it is the path of the height map, and no solid
// is needed. Otherwise it is the path of the solid.
Result<void> take_output(MakeArguments& arguments) {
  const std::string& path = arguments.output;
  ReliefFiles& files = arguments.files;
  if (path.empty())
    return option_error("output", cat("expected a file ending in ", either(output_endings())));
  const bool is_map = std::ranges::count(map_endings, cat(".", ending_of(path))) > 0;
  if (is_map && !files.heightmap.empty())
    return option_error("heightmap", cat("expected one height map, found ", path, " as output, too"));
  (is_map ? files.heightmap : files.solid) = path;
  return {};
}

Result<CheckedOrder> order_of(MakeArguments& arguments) {
  MakeOrder& order = arguments.order;
  RELIEVO_TRY(arguments.files.unit, parse_unit(arguments.units));
  RELIEVO_TRY(order.input_arguments, parse_input_texts(arguments.in));
  order.values.insert(arguments.in.depth.begin(), arguments.in.depth.end());
  order.paths_read = paths_read_by(order);
  RELIEVO_TRY(CheckedOrder known, check_order(std::move(order)));
  RELIEVO_CHECK(take_output(arguments));
  RELIEVO_CHECK(check_outputs(arguments.files, known.paths_read, known.options.tool.has_value()));
  return known;
}

std::string outcome(const ReliefFiles& outputs, const MadeRelief& made) {
  const auto in_units = [&](double mm) { return std::round(mm / mm_per(outputs.unit) * 1e4) / 1e4; };
  const ReliefReport& report = made.report;
  const Vec3 size = Box::of(made.solid.points).size();
  const std::string_view unit = name_of(outputs.unit);
  const double below_ground = in_units(report.below_ground_mm);
  return cat(outputs.solid.empty() ? outputs.heightmap : outputs.solid, ": ", report.visible_points, " of ",
             report.input_points, " points are visible in this view, height ", in_units(report.height_mm),
             " ", unit, below_ground > 0 ? cat(" (", below_ground, " of it below the ground)") : "",
             ", body ", in_units(size.x()), " x ", in_units(size.y()), " x ", in_units(size.z()), " ", unit);
}

// The finished files, still in memory, and the lines to print about them.
struct Finished {
  std::vector<OutputFile> files;
  std::vector<std::string> lines;
};

Result<Finished> run(CheckedOrder order, const ReliefFiles& outputs, Progress& progress) {
  RELIEVO_TRY(LoadedOrder loaded, load(std::move(order), progress));
  const auto side = loaded.side;
  RELIEVO_TRY(FinishedRelief relief, app::make(std::move(loaded), progress));
  if (side)
    relief.inputs.remarks.push_back(
        cat("view ", side->name, side->up.empty() ? "" : cat(" with up ", side->up)));
  (void)progress.stage("files", .97);
  RELIEVO_TRY(MadeFiles made, relief_files(outputs, relief.made, relief.draft_deg));
  relief.end(progress);
  if (!outputs.report.empty()) made.files.push_back(report_file(outputs, relief, made.height_map));
  Finished finished{std::move(made.files), relief.remarks()};
  finished.lines.push_back(outcome(outputs, relief.made));
  if (!made.height_map.is_null()) finished.lines.push_back(line_of(made.height_map));
  return finished;
}

Result<void> make(MakeArguments& arguments) {
  RELIEVO_TRY(CheckedOrder order, order_of(arguments));
  set_thread_count(arguments.threads);
  Progress progress(progress_bar(arguments.is_quiet));
  const Result<Finished> finished = run(std::move(order), arguments.files, progress);
  progress.finish();  // erases the progress bar; an error is printed after that
  if (!finished) return std::unexpected(finished.error());
  RELIEVO_CHECK(write_files(finished->files));
  for (const std::string& line : finished->lines)
    if (!arguments.is_quiet) std::fprintf(stderr, "%s\n", on_one_line(line).c_str());
  return {};
}

// -------------------------------------------------------------------------------------------------- flags

struct TextFlag {
  const char *name, *type, *help;
  std::string ReliefFiles::*value;
};

constexpr TextFlag outputs[] = {
    {"--preview", "P.png", "picture of the relief", &ReliefFiles::preview},
    {"--heightmap", "H.png", "height map of the front: .png of 16 bits, or .tif in millimetres",
     &ReliefFiles::heightmap},
    {"--tool-picture", "T.png", "the front, with what the tool leaves in red", &ReliefFiles::tool_picture},
    {"--report", "R.json", "what was made and how, as JSON", &ReliefFiles::report}};

void add_input(CLI::App& command, MakeArguments& arguments) {
  command
      .add_option(
          "input", arguments.order.inputs,
          cat(readable_formats(), "; several of them side by side; a scene (JSON) or a studio's project"))
      ->required()
      ->type_name("INPUT");
}

void add_files(CLI::App& command, MakeArguments& arguments) {
  command
      .add_option("-o,--output", arguments.output,
                  cat("the solid, or a height map alone: ", either(output_endings())))
      ->required()
      ->type_name("OUT");
  for (const TextFlag& flag : outputs)
    command.add_option(flag.name, arguments.files.*flag.value, flag.help)->type_name(flag.type);
  command.add_option("--scan", arguments.order.scan_path, "the scan of a project, where it is not found")
      ->type_name("S.ply");
}

}  // namespace

void add_make(CLI::App& program, Result<void>& result) {
  const auto arguments = std::make_shared<MakeArguments>();
  CLI::App& command = *program.add_subcommand("make", "Make a relief from a scan");
  add_input(command, *arguments);
  add_files(command, *arguments);
  add_make_options(command, *arguments);
  add_number(command, "--threads", arguments->threads, CLI::Range(0, 256), "0 for all [0 to 256]");
  command.add_flag("--quiet", arguments->is_quiet, "print errors only");
  command.callback([arguments, &result] { result = make(*arguments); });
}

}  // namespace relievo::app::cli
