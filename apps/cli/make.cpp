#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/flags.h"
#include "cli/make_options.h"
#include "cli/terminal.h"
#include "common/export_file.h"
#include "common/files.h"
#include "common/make_report.h"
#include "common/project.h"
#include "common/project_file.h"
#include "common/relief_files.h"
#include "common/wording.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/io/read.h"

namespace relievo::app::cli {
namespace {

// The arguments as the user types them.
struct MakeArguments : MakeOptions {
  std::vector<std::string> inputs;
  ReliefFiles outputs;
  std::string scan;
  int threads = 0;
  bool is_quiet = false;
};

// The same arguments after parsing.
struct MakeOrder {
  MakeArguments arguments;
  ReliefOptions relief;
  InputArguments in;
  std::optional<StoredProject> project;
};

// ---------------------------------------------------------------------------------------------- arguments

// Takes what a project says, but for the flags that were given.
Result<std::optional<StoredProject>> take_project(MakeArguments& arguments, const CLI::App& command) {
  RELIEVO_TRY(std::optional<StoredProject> stored, find_project(arguments.inputs, arguments.scan));
  if (!stored) return std::nullopt;
  const auto is_given = [&](std::string_view name) { return command.count(cat("--", name)) > 0; };
  arguments.relief = with_given(stored->project.options, arguments.relief, is_given);
  return stored;
}

Result<MakeOrder> order_of(MakeArguments arguments, const CLI::App& command) {
  MakeOrder order;
  RELIEVO_TRY(arguments.outputs.unit, parse_unit(arguments.units));
  arguments.outputs.heightmap_px = arguments.heightmap_px;
  arguments.outputs.preview_px = arguments.preview_px;
  RELIEVO_TRY(order.project, take_project(arguments, command));
  const bool has_base = command.count("--base") > 0 || arguments.relief.base != OptionTexts{}.base;
  if (!arguments.base_image.empty() && !has_base) arguments.relief.base = "image";
  RELIEVO_TRY(order.relief, parse_options(arguments.relief));
  std::optional<Project> project;
  if (order.project) project = order.project->project;
  RELIEVO_TRY(std::shared_ptr<const Image<float>> base_image,
              base_image_for(order.relief.base, arguments.base_image, project));
  RELIEVO_CHECK(take_base_image(std::move(base_image), order.relief.base));
  RELIEVO_TRY(order.in, parse_input_texts(arguments.in));
  if (arguments.outputs.solid.empty())
    return option_error("output", cat("expected a file ending in ", either(solid_endings())));
  std::vector<std::string> inputs = arguments.inputs;
  inputs.insert(inputs.end(), {arguments.base_image, arguments.scan});
  RELIEVO_CHECK(check_outputs(arguments.outputs, std::move(inputs), order.relief.tool.has_value()));
  order.arguments = std::move(arguments);
  return order;
}

// --------------------------------------------------------------------------------------------------- work

Result<SceneInput> load(const MakeOrder& order, Progress& progress) {
  if (!order.project)
    return read_scene(order.arguments.inputs, order.in,
                      {order.relief.view, order.relief.points.value_or(PointsWanted{}.points)}, &progress);
  RELIEVO_CHECK(progress.stage("read", 0));
  RELIEVO_TRY(Scene scene, load_project_scan(*order.project));
  return with_remarks(std::move(scene));
}

Result<std::vector<OutputFile>> finished_files(const MakeOrder& order, const Scene& scene,
                                               const MadeRelief& made, Progress& progress) {
  const ReliefFiles& to = order.arguments.outputs;
  RELIEVO_TRY(std::vector<OutputFile> files, relief_files(to, made, order.relief.draft_deg));
  progress.finish();
  if (to.report.empty()) return files;
  const nlohmann::json models = models_report(scene, order.relief.view);
  const nlohmann::json report = make_report({made, models, to.unit, progress.times()});
  files.push_back({to.report, bytes_of(report_text(report))});
  return files;
}

// Prints one line about what was made, in the unit asked for.
std::string outcome(const MakeOrder& order, const MadeRelief& made) {
  const LengthUnit in = order.arguments.outputs.unit;
  const auto in_units = [&](double mm) { return std::round(mm / mm_per(in) * 1e4) / 1e4; };
  const ReliefReport& report = made.report;
  const Vec3 size = size_mm(made.solid);
  const std::string_view unit = name_of(in);
  const double below_ground = in_units(report.below_ground_mm);
  return cat(order.arguments.outputs.solid, ": ", report.visible_points, " of ", report.input_points,
             " points, height ", in_units(report.height_mm), " ", unit,
             below_ground > 0 ? cat(" (", below_ground, " of it below the ground)") : "", ", body ",
             in_units(size.x()), " x ", in_units(size.y()), " x ", in_units(size.z()), " ", unit);
}

// Every file in memory, and the lines to say about them.
struct Finished {
  std::vector<OutputFile> files;
  std::vector<std::string> lines;
};

// Chooses the view where it is still to be chosen, and says which.
void choose_view(const Scene& scene, View& view, std::vector<std::string>& remarks) {
  if (!view.is_best) return;
  const ViewGuess side = best_side(scene);
  view = on_side(view, side);
  remarks.push_back(cat("view ", side.name, side.up.empty() ? "" : cat(" with up ", side.up)));
}

Result<Finished> run(MakeOrder order, Progress& progress) {
  RELIEVO_TRY(SceneInput input, load(order, progress));
  choose_view(input.scene, order.relief.view, input.remarks);
  Result<MadeRelief> made = make_relief(input.scene, order.relief, &progress);
  if (!made) {
    if (made.error().input.empty()) made.error().input = joined(order.arguments.inputs);
    return std::unexpected(made.error());
  }
  (void)progress.stage("files", .97);
  RELIEVO_TRY(std::vector<OutputFile> files, finished_files(order, input.scene, *made, progress));
  Finished finished{std::move(files), input.remarks};
  for (const std::string& line : remarks_on(made->report)) finished.lines.push_back(line);
  finished.lines.push_back(outcome(order, *made));
  return finished;
}

Result<void> make(const MakeArguments& arguments, const CLI::App& command) {
  RELIEVO_TRY(const MakeOrder order, order_of(arguments, command));
  set_thread_count(arguments.threads);
  Progress progress(progress_bar(arguments.is_quiet));
  const Result<Finished> finished = run(order, progress);
  progress.finish();  // erases the bar, also before an error
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
          "input", arguments.inputs,
          cat(readable_formats(), "; several of them side by side; a scene (JSON) or a studio's project"))
      ->required()
      ->type_name("INPUT");
}

void add_files(CLI::App& command, MakeArguments& arguments) {
  command.add_option("-o,--output", arguments.outputs.solid, cat("the solid: ", either(solid_endings())))
      ->required()
      ->type_name("OUT");
  for (const TextFlag& flag : outputs)
    command.add_option(flag.name, arguments.outputs.*flag.value, flag.help)->type_name(flag.type);
  command.add_option("--scan", arguments.scan, "the scan of a project, where it is not found")
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
  command.callback([arguments, &command, &result] { result = make(*arguments, command); });
}

}  // namespace relievo::app::cli
