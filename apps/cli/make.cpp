#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/flags.h"
#include "cli/input_flags.h"
#include "cli/make_report.h"
#include "cli/terminal.h"
#include "common/export_file.h"
#include "common/files.h"
#include "common/project.h"
#include "common/wording.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/io/read.h"
#include "relievo/io/write.h"
#include "relievo/picture/preview.h"
#include "relievo/picture/reach_picture.h"
#include "relievo/plate/draft_in_file.h"
#include "relievo/relief/draft.h"

namespace relievo::app::cli {
namespace {

// The arguments as the user types them.
struct MakeArguments {
  std::vector<std::string> inputs;
  std::string output, preview, heightmap, tool_picture, report, base_image;
  int heightmap_px = 1024;
  int threads = 0;
  bool is_quiet = false;
  std::string units = "mm";
  OptionTexts relief;
  InputTexts in;
};

// The same arguments after parsing.
struct MakeOrder {
  MakeArguments files;
  ReliefOptions relief;
  InputArguments in;
  std::optional<ScanSource> scan;  // of a project
  LengthUnit unit = LengthUnit::mm;
};

// ---------------------------------------------------------------------------------------------- arguments

// Each output has a place of its own that can be written to.
Result<void> check_outputs(const MakeArguments& arguments) {
  using Endings = std::vector<std::string_view>;
  std::vector<std::string> taken = arguments.inputs;
  taken.push_back(arguments.base_image);
  RELIEVO_CHECK(check_output(arguments.output, solid_endings(), taken));
  taken.push_back(arguments.output);
  for (const auto& [path, endings] : {std::pair<std::string, Endings>{arguments.preview, {".png"}},
                                      {arguments.heightmap, {".png", ".tif", ".tiff"}},
                                      {arguments.tool_picture, {".png"}},
                                      {arguments.report, {}}}) {
    if (path.empty()) continue;
    RELIEVO_CHECK(check_output(path, endings, taken));
    taken.push_back(path);
  }
  if (!arguments.tool_picture.empty() && arguments.relief.tool.empty())
    return option_error("tool-picture", "expected a tool, which it shows");
  return {};
}

// Reads the height map of a base of kind image.
Result<void> take_base_image(const std::string& path, BaseOptions& base) {
  const bool is_image = base.kind == BaseKind::image;
  if (!is_image && path.empty()) return {};
  if (path.empty()) return option_error("base", "expected base-image with image, found none");
  if (!is_image)
    return option_error("base-image",
                        cat("expected base image with it, found ", name_in(base_choices, base.kind)));
  RELIEVO_TRY(const std::vector<std::byte> bytes, read_file(path, true));
  RELIEVO_TRY(DepthImage image, read_depth_image(bytes, path));
  base.image = std::make_shared<const Image<float>>(std::move(image.values));
  return {};
}

// Takes what a project says, but for the flags that were given.
Result<std::optional<ScanSource>> take_project(MakeArguments& arguments, const CLI::App& command) {
  const std::string& input = arguments.inputs[0];
  if (arguments.inputs.size() > 1 || ending_of(input) != "relievo") return std::nullopt;
  RELIEVO_TRY(const std::vector<std::byte> bytes, read_file(input));
  RELIEVO_TRY(Project project,
              read_project({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, input));
  if (command.count("--alpha") > 0) project.options.height_mm = std::nullopt;
  for (const ReliefField& field : option_fields())
    if (command.count(FlagAdder::flag(field)) > 0)
      std::visit([&](const auto member) { project.options.*member = arguments.relief.*member; }, field.value);
  arguments.relief = project.options;
  return project.input;
}

Result<MakeOrder> order_of(MakeArguments arguments, const CLI::App& command) {
  MakeOrder order;
  RELIEVO_TRY(order.unit, parse_unit(arguments.units));
  RELIEVO_TRY(order.scan, take_project(arguments, command));
  const bool has_base = command.count("--base") > 0 || arguments.relief.base != OptionTexts{}.base;
  if (!arguments.base_image.empty() && !has_base) arguments.relief.base = "image";
  RELIEVO_TRY(order.relief, parse_options(arguments.relief));
  RELIEVO_CHECK(take_base_image(arguments.base_image, order.relief.base));
  RELIEVO_TRY(order.in, parse_input_texts(arguments.in));
  RELIEVO_CHECK(check_outputs(arguments));
  order.files = std::move(arguments);
  return order;
}

// --------------------------------------------------------------------------------------------------- work

Result<SceneInput> load(const MakeOrder& order, Progress& progress) {
  if (!order.scan)
    return read_scene(order.files.inputs, order.in, {order.relief.view, order.relief.points}, &progress);
  RELIEVO_CHECK(progress.stage("read", 0));
  ScanSource scan = *order.scan;
  RELIEVO_TRY(Scene scene, load_input(scan, std::filesystem::path(order.files.inputs[0]).parent_path()));
  return SceneInput{std::move(scene), {}};
}

// The solid as a file. In inches its coordinates are rounded anew, which tilts needles.
Result<std::vector<std::byte>> solid_file(const MakeOrder& order, const Solid& solid) {
  const auto write = find_solid_format(ending_of(order.files.output))->write_solid;
  if (order.unit == solid.unit) return write(solid);
  Solid other = in_unit(solid, order.unit);
  if (order.relief.draft_deg)
    RELIEVO_CHECK(enforce_draft_in_float(other, slope_at_draft(*order.relief.draft_deg)));
  return write(other);
}

Result<std::vector<OutputFile>> finished_files(const MakeOrder& order, const Scene& scene,
                                               const MadeRelief& made, Progress& progress) {
  const MakeArguments& to = order.files;
  RELIEVO_TRY(std::vector<std::byte> solid, solid_file(order, made.solid));
  std::vector<OutputFile> files;
  files.push_back({to.output, std::move(solid)});
  const HeightMapOrder map{to.heightmap_px, ending_of(to.heightmap) != "png", order.unit};
  if (!to.heightmap.empty()) files.push_back({to.heightmap, height_map_file(made, map)});
  if (!to.preview.empty()) files.push_back({to.preview, write_png(render_preview(made.solid, {}))});
  if (!to.tool_picture.empty())
    files.push_back({to.tool_picture, write_png(render_reach(*made.report.reach, 1600))});
  progress.finish();
  if (!to.report.empty())
    files.push_back(
        {to.report, bytes_of(make_report({made, scene, order.relief.view, order.unit, progress}))});
  return files;
}

// Prints one line about what was made, in the unit asked for.
std::string outcome(const MakeOrder& order, const MadeRelief& made) {
  const auto in_units = [&](double mm) { return std::round(mm / mm_per(order.unit) * 1e4) / 1e4; };
  const ReliefReport& report = made.report;
  const Vec3 size = size_mm(made.solid);
  const std::string_view unit = name_of(order.unit);
  const double below_ground = in_units(report.below_ground_mm);
  return cat(order.files.output, ": ", report.visible_points, " of ", report.input_points, " points, height ",
             in_units(report.height_mm), " ", unit,
             below_ground > 0 ? cat(" (", below_ground, " of it below the ground)") : "", ", body ",
             in_units(size.x()), " x ", in_units(size.y()), " x ", in_units(size.z()), " ", unit);
}

// Every file in memory, and the lines to say about them.
struct Finished {
  std::vector<OutputFile> files;
  std::vector<std::string> lines;
};

Result<Finished> run(const MakeOrder& order, Progress& progress) {
  RELIEVO_TRY(const SceneInput input, load(order, progress));
  Result<MadeRelief> made = make_relief(input.scene, order.relief, &progress);
  if (!made) {
    if (made.error().input.empty()) made.error().input = joined(order.files.inputs);
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
  std::string MakeArguments::*value;
};

constexpr TextFlag outputs[] = {
    {"--preview", "P.png", "picture of the relief", &MakeArguments::preview},
    {"--heightmap", "H.png", "height map of the front: .png of 16 bits, or .tif in millimetres",
     &MakeArguments::heightmap},
    {"--tool-picture", "T.png", "the front, with what the tool leaves in red", &MakeArguments::tool_picture},
    {"--report", "R.json", "what was made and how, as JSON", &MakeArguments::report},
    {"--base-image", "B.png", "height map that the relief lies on, bright is high: PNG or TIFF",
     &MakeArguments::base_image}};

void add_input(CLI::App& command, MakeArguments& arguments) {
  command
      .add_option(
          "input", arguments.inputs,
          cat(readable_formats(), "; several of them side by side; a scene (JSON) or a studio's project"))
      ->required()
      ->type_name("INPUT");
}

void add_files(CLI::App& command, MakeArguments& arguments) {
  command.add_option("-o,--output", arguments.output, cat("the solid: ", either(solid_endings())))
      ->required()
      ->type_name("OUT");
  for (const TextFlag& flag : outputs)
    command.add_option(flag.name, arguments.*flag.value, flag.help)->type_name(flag.type);
}

void add_number(CLI::App& command, const char* name, int& value, const CLI::Range& range, const char* help) {
  command.add_option(name, value, help)
      ->check(CLI::Range(range).description(""))
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace

void add_make(CLI::App& program, Result<void>& result) {
  const auto arguments = std::make_shared<MakeArguments>();
  CLI::App& command = *program.add_subcommand("make", "Make a relief from a scan");
  add_input(command, *arguments);
  add_files(command, *arguments);
  command
      .add_option("--units", arguments->units,
                  "mm or in: of lengths without a unit of their own, and of the solid's coordinates")
      ->type_name("UNIT")
      ->capture_default_str();
  add_number(command, "--heightmap-size", arguments->heightmap_px, CLI::Range(16, 16384),
             "its longer side in pixels [16 to 16384]");
  add_flags(command, arguments->relief);
  const auto refuse = [](const std::string&) {
    throw CLI::ValidationError("--surface", "expected --finish, its new name");
  };
  command.add_option_function<std::string>("--surface", refuse)->group("");
  add_input_flags(command, arguments->in);
  add_number(command, "--threads", arguments->threads, CLI::Range(0, 256), "0 for all [0 to 256]");
  command.add_flag("--quiet", arguments->is_quiet, "print errors only");
  command.callback([arguments, &command, &result] { result = make(*arguments, command); });
}

}  // namespace relievo::app::cli
