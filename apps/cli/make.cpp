#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "export_file.h"
#include "files.h"
#include "flags.h"
#include "project.h"
#include "read_inputs.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"
#include "relievo/depth_image.h"
#include "relievo/make_relief.h"
#include "relievo/picture/height_map.h"
#include "relievo/preview.h"
#include "relievo/relief/draft.h"
#include "terminal.h"

namespace relievo::cli {
namespace {

struct MakeArguments {
  std::vector<std::string> inputs;
  std::string output, preview, heightmap, tool_picture, report, base_image;
  int heightmap_px = 1024;
  int threads = 0;
  bool is_quiet = false;
  std::string units = "mm";
  ReliefOptions relief;
  std::optional<studio::Input> scan;  // of a project
  InputArguments in;
};

LengthUnit unit_of(const MakeArguments& arguments) {
  return *parse_unit(arguments.units);
}

using SolidWriter = std::vector<std::byte> (*)(const Solid&);

std::vector<std::byte> as_3mf(const Solid& solid) {
  const std::pair<std::string, std::string> metadata[] = {{"Title", "Relief"},
                                                          {"Application", cat("relievo ", version)}};
  return write_3mf(solid, metadata);
}

const std::map<std::string, SolidWriter>& solid_writers() {
  static const std::map<std::string, SolidWriter> writers{
      {"stl", write_stl}, {"ply", write_ply}, {"obj", write_obj}, {"3mf", as_3mf}};
  return writers;
}

// Each output has a place of its own that can be written to.
Result<void> check_places(const MakeArguments& arguments) {
  std::vector<std::string> taken = arguments.inputs;
  taken.push_back(arguments.base_image);
  for (const std::string& path :
       {arguments.output, arguments.preview, arguments.heightmap, arguments.tool_picture, arguments.report}) {
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
        Error{ErrorKind::option, arguments.output, {}, "expected a file ending in .stl, .3mf, .ply or .obj"});
  if (!arguments.preview.empty() && ending_of(arguments.preview) != "png")
    return std::unexpected(Error{ErrorKind::option, arguments.preview, {}, "expected a file ending in .png"});
  if (!arguments.tool_picture.empty() && ending_of(arguments.tool_picture) != "png")
    return std::unexpected(
        Error{ErrorKind::option, arguments.tool_picture, {}, "expected a file ending in .png"});
  if (!arguments.tool_picture.empty() && arguments.relief.tool.empty())
    return std::unexpected(Error{ErrorKind::option, "--tool-picture", {}, "expected --tool, which it shows"});
  const std::string map = ending_of(arguments.heightmap);
  if (!arguments.heightmap.empty() && map != "png" && map != "tif" && map != "tiff")
    return std::unexpected(
        Error{ErrorKind::option, arguments.heightmap, {}, "expected a file ending in .png or .tif"});
  return check_places(arguments);
}

nlohmann::json wrap_json(const std::optional<ReliefReport::Wrapped>& wrap) {
  if (!wrap) return {};
  return {{"diameter_mm", wrap->diameter_mm},
          {"turn_degrees", wrap->turn_deg},
          {"mm_per_degree", wrap->mm_per_degree}};
}

nlohmann::json reach_json(const ReliefReport& report) {
  if (!report.reach) return {};
  return {{"reached_share", report.reach->reached_share},
          {"largest_residual_mm", report.reach->largest_residual_mm},
          {"tolerance_mm", report.reach->tolerance_mm},
          {"mm_per_sample", report.reach->mm_per_sample}};
}

std::vector<double> row_by_row(const Mat3& m) {
  std::vector<double> values;
  for (int i = 0; i < 9; ++i) values.push_back(m(i / 3, i % 3));
  return values;
}

std::vector<double> as_list(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

// What stands in the scene, and where: a point p of a file is scale * rotation * p + offset in it.
nlohmann::json models_json(const Scene& scene, const ReliefOptions& options) {
  const Result<View> view = parse_view(options.view, options.up);
  const auto places = place_models(scene, view.value_or(View{}));
  nlohmann::json models = nlohmann::json::array();
  for (std::size_t i = 0; places && i < places->size(); ++i) {
    const CloudFile& file = *scene.models[i].file;
    const PlacedModel& place = (*places)[i];
    models.push_back({{"file", scene.models[i].name},
                      {"format", file.format},
                      {"points", file.cloud.size()},
                      {"triangles", file.mesh.triangles.size()},
                      {"model_to_scene",
                       {{"rotation", row_by_row(place.turn)},
                        {"scale", place.scale},
                        {"offset", as_list(place.offset)}}}});
  }
  return models;
}

nlohmann::json report_json(const ReliefReport& report, const Progress& progress) {
  const auto number_or_null = [](double x) {
    return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json();
  };
  nlohmann::json seconds = nlohmann::json::object();
  for (const StageTime& stage : progress.times())
    seconds[stage.name] = seconds.value(stage.name, 0.0) + stage.seconds;
  return {
      {"version", version},
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
      {"steepest_deg", report.steepest_deg},
      {"tool", reach_json(report)},
      {"simplification_error_mm",
       report.simplification_error_mm ? nlohmann::json(*report.simplification_error_mm) : nlohmann::json()},
      {"wrap", wrap_json(report.wrap)},
      {"seconds", seconds},
      {"model_to_mm",
       {{"rotation", row_by_row(report.rotation)},
        {"scale", report.scale},
        {"offset", as_list(report.offset)}}},
      {"remarks", report.remarks}};
}

std::vector<std::byte> text_bytes(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

Result<SceneInput> load(const MakeArguments& arguments, Progress& progress) {
  if (!arguments.scan) return read_scene(arguments.inputs, arguments.in, arguments.relief, &progress);
  if (auto go = progress.stage("read", 0); !go) return std::unexpected(go.error());
  studio::Input scan = *arguments.scan;
  Result<Scene> scene = studio::load_input(scan, std::filesystem::path(arguments.inputs[0]).parent_path());
  if (!scene) return std::unexpected(scene.error());
  return SceneInput{std::move(*scene), {}};
}

// The solid as a file. In inches its coordinates are rounded anew, which tilts needles.
Result<std::vector<std::byte>> solid_file(const MakeArguments& arguments, const Solid& solid) {
  const SolidWriter write = solid_writers().at(ending_of(arguments.output));
  if (unit_of(arguments) == solid.unit) return write(solid);
  Solid other = in_unit(solid, unit_of(arguments));
  if (arguments.relief.draft_deg)
    if (auto held = hold_draft(other, slope_at_draft(*arguments.relief.draft_deg)); !held)
      return std::unexpected(held.error());
  return write(other);
}

Vec3 size_mm(const Solid& solid) {
  Box box;
  for (const Vec3& p : solid.points) box.extend(p);
  return box.size();
}

Result<std::vector<OutputFile>> finished_files(const MakeArguments& arguments, const Scene& scene,
                                               const MadeRelief& made, Progress& progress) {
  Result<std::vector<std::byte>> solid = solid_file(arguments, made.solid);
  if (!solid) return std::unexpected(solid.error());
  std::vector<OutputFile> files;
  files.push_back({arguments.output, std::move(*solid)});
  const studio::HeightMapOrder map{arguments.heightmap_px, ending_of(arguments.heightmap) != "png",
                                   unit_of(arguments)};
  if (!arguments.heightmap.empty())
    files.push_back({arguments.heightmap, studio::height_map_file(made, map)});
  if (!arguments.preview.empty())
    files.push_back({arguments.preview, write_png(render_preview(made.solid, {}))});
  if (!arguments.tool_picture.empty())
    files.push_back({arguments.tool_picture, write_png(render_reach(*made.report.reach, 1600))});
  progress.finish();
  if (arguments.report.empty()) return files;
  nlohmann::json report = report_json(made.report, progress);
  const Vec3 size = size_mm(made.solid);
  report["size_mm"] = {size.x(), size.y(), size.z()};
  report["units"] = arguments.units;
  report["models"] = models_json(scene, arguments.relief);
  files.push_back({arguments.report, text_bytes(report.dump(2) + "\n")});
  return files;
}

// Every file in memory, and the lines to say about them.
struct Finished {
  std::vector<OutputFile> files;
  std::vector<std::string> lines;
};

// What was made, in a line and in the unit asked for.
std::string outcome(const MakeArguments& arguments, const MadeRelief& made) {
  const auto in_units = [&](double mm) { return std::round(mm / mm_per(unit_of(arguments)) * 1e4) / 1e4; };
  const ReliefReport& report = made.report;
  const Vec3 size = size_mm(made.solid);
  return cat(arguments.output, ": ", report.visible_points, " of ", report.input_points, " points, height ",
             in_units(report.height_mm), " ", arguments.units, " (", in_units(report.below_ground_mm),
             " of it below the ground), body ", in_units(size.x()), " x ", in_units(size.y()), " x ",
             in_units(size.z()), " ", arguments.units);
}

Result<Finished> run(const MakeArguments& arguments, Progress& progress) {
  const Result<SceneInput> input = load(arguments, progress);
  if (!input) return std::unexpected(input.error());
  Finished finished{{}, input->remarks};
  Result<MadeRelief> made = make_relief(input->scene, arguments.relief, &progress);
  if (!made) {
    if (made.error().input.empty()) made.error().input = joined(arguments.inputs);
    return std::unexpected(made.error());
  }
  (void)progress.stage("files", .97);
  Result<std::vector<OutputFile>> files = finished_files(arguments, input->scene, *made, progress);
  if (!files) return std::unexpected(files.error());
  finished.files = std::move(*files);
  const ReliefReport& report = made->report;
  finished.lines.insert(finished.lines.end(), report.remarks.begin(), report.remarks.end());
  finished.lines.push_back(outcome(arguments, *made));
  return finished;
}

Result<void> make(const MakeArguments& arguments) {
  if (auto ok = check(arguments.relief); !ok) return ok;
  if (auto ok = check(arguments.in.depth); !ok) return ok;
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

// Reads the height image of a base, which is then its shape unless another was asked for.
Result<void> take_base_image(MakeArguments& arguments, bool has_base) {
  ReliefOptions& relief = arguments.relief;
  if (!arguments.base_image.empty() && !has_base && relief.base == "plane") relief.base = "image";
  const Result<BaseOptions> base = parse_base(relief.base);
  if (!base) return std::unexpected(base.error());
  const bool is_image = base->kind == BaseKind::image;
  if (!is_image && arguments.base_image.empty()) return {};
  if (arguments.base_image.empty())
    return std::unexpected(
        Error{ErrorKind::option, "--base", {}, "expected --base-image with image, found none"});
  if (!is_image)
    return std::unexpected(Error{ErrorKind::option,
                                 "--base-image",
                                 {},
                                 cat("expected --base image with it, found '", relief.base, "'")});
  const Result<std::vector<std::byte>> bytes = read_file(arguments.base_image);
  if (!bytes) return std::unexpected(bytes.error());
  Result<DepthImage> image = read_depth_image(*bytes, arguments.base_image);
  if (!image) return std::unexpected(image.error());
  relief.base_image =
      std::make_shared<const HeightGrid>(image->width, image->height, std::move(image->values));
  return {};
}

// Takes what a project says, but for the flags that were given.
Result<void> take_project(MakeArguments& arguments, const CLI::App& command) {
  const std::string& input = arguments.inputs[0];
  if (arguments.inputs.size() > 1 || ending_of(input) != "relievo") return {};
  const Result<std::vector<std::byte>> bytes = read_file(input);
  if (!bytes) return std::unexpected(bytes.error());
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  Result<studio::Project> project = studio::read_project(text, input);
  if (!project) return std::unexpected(project.error());
  visit(project->options, [&](const OptionField& field, auto& value) {
    if (command.count(FlagAdder::flag(field)) == 0) return;
    if (field.name == "alpha") project->options.height_mm = std::nullopt;
    visit(arguments.relief, [&](const OptionField& other, auto& given) {
      if constexpr (std::is_same_v<decltype(value), decltype(given)>)
        if (other.name == field.name) value = given;
    });
  });
  arguments.relief = project->options;
  arguments.scan = project->input;
  return {};
}

}  // namespace

void add_make(CLI::App& program, Result<void>& result) {
  const auto arguments = std::make_shared<MakeArguments>();
  CLI::App& command = *program.add_subcommand("make", "Make a relief from a scan");
  command
      .add_option(
          "input", arguments->inputs,
          "point cloud (PLY, PCD, LAS, XYZ, PTS), mesh (PLY, STL, OBJ, OFF, GLB) or depth image (PNG, "
          "TIFF); several of them side by side; a scene (JSON) or a studio's project")
      ->required()
      ->type_name("INPUT");
  command.add_option("-o,--output", arguments->output, "the solid: .stl, .3mf, .ply or .obj")
      ->required()
      ->type_name("OUT");
  command.add_option("--preview", arguments->preview, "picture of the relief")->type_name("P.png");
  command
      .add_option("--heightmap", arguments->heightmap,
                  "height map of the front: .png of 16 bits, or .tif in millimetres")
      ->type_name("H.png");
  command
      .add_option("--tool-picture", arguments->tool_picture, "the front, with what the tool leaves in red")
      ->type_name("T.png");
  command
      .add_option("--units", arguments->units,
                  "mm or in: of lengths without a unit of their own, and of the solid's coordinates")
      ->check([](const std::string& name) {
        const auto unit = parse_unit(name);
        return unit ? std::string() : unit.error().expected;
      })
      ->type_name("UNIT")
      ->capture_default_str();
  command.add_option("--heightmap-size", arguments->heightmap_px, "its longer side [16 to 16384]")
      ->check(CLI::Range(16, 16384).description(""))
      ->type_name("PX")
      ->capture_default_str();
  add_flags(command, arguments->relief);
  add_input_flags(command, arguments->in);
  command
      .add_option("--base-image", arguments->base_image,
                  "height map that the relief lies on, bright is high: PNG or TIFF")
      ->type_name("B.png");
  command.add_option("--threads", arguments->threads, "0 for all [0 to 256]")
      ->check(CLI::Range(0, 256).description(""))
      ->type_name("N")
      ->capture_default_str();
  command.add_option("--report", arguments->report, "what was made and how, as JSON")->type_name("R.json");
  command.add_flag("--quiet", arguments->is_quiet, "print errors only");
  command.callback([arguments, &command, &result] {
    if (const auto tool = parse_tool(arguments->relief.tool, unit_of(*arguments)); tool)
      arguments->relief.tool = text_of(*tool);
    result = take_project(*arguments, command);
    if (result) result = take_base_image(*arguments, command.count("--base") > 0);
    if (result) result = make(*arguments);
  });
}

}  // namespace relievo::cli
