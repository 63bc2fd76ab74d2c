#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/input_flags.h"
#include "cli/sheet.h"
#include "cli/terminal.h"
#include "common/files.h"
#include "relievo/core/image.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/io/write.h"
#include "relievo/make_relief.h"
#include "relievo/quality/measures.h"
#include "relievo/relief/method.h"
#include "relievo/relief/relief.h"
#include "relievo/scan/surface.h"
#include "relievo/scan/view.h"

namespace relievo::app::cli {
namespace {

struct CompareArguments {
  SceneArguments scene;
  std::string output;
  std::vector<double> heights{.0125, .025, .05};  // of the width
  std::vector<std::string> methods;
  int threads = 0;
  bool is_json = false, is_quiet = false;
};

struct Entry {
  Method method;
  double height = 0;  // of the width
  Measures measures;
  Image8 picture;
};

struct Comparison {
  std::size_t visible_points = 0, measured_pixels = 0;
  Image8 model;
  std::vector<Entry> entries;  // by height, then by method
  std::vector<std::string> remarks;
};

constexpr float light_x = -1, light_y = 1, light_z = 1;

Result<std::vector<Method>> parse_methods(const std::vector<std::string>& names) {
  std::vector<Method> chosen;
  if (names.empty())
    for (const MethodInfo& info : methods) chosen.push_back(info.method);
  for (const std::string& name : names) {
    RELIEVO_TRY(const Method method, parse_method(name, "methods"));
    chosen.push_back(method);
  }
  return chosen;
}

double longer_side(const Surface& surface) {
  return Box::of(surface.points).longer_side();
}

// Reliefs of one height by each method, measured.
Result<std::vector<Entry>> entries_at(double share, const std::vector<Method>& chosen,
                                      const ReliefModel& model, const ReliefMetrics& judge) {
  const double width = longer_side(model.surface());
  std::vector<Entry> entries;
  for (const Method method : chosen) {
    // A height out of reach is told for a relief of 100 mm.
    Result<Relief> relief = make_by_method(method, model, share * width, default_shape(method), 100 / width);
    if (!relief) return std::unexpected(relief.error());
    entries.push_back({method, share, judge.measure(relief->heights),
                       judge.shade(relief->heights, Vec3f(light_x, light_y, light_z))});
  }
  return entries;
}

Result<Comparison> compare_all(const CompareArguments& arguments, const std::vector<Method>& chosen,
                               Progress& progress) {
  RELIEVO_TRY(const SampledView seen, read_sample(arguments.scene, &progress));
  RELIEVO_TRY(const ReliefModel model, prepare(*seen.sample.cloud, seen.view, Mode::exact, &progress));
  RELIEVO_CHECK(progress.stage("comparison", .85));
  const ReliefMetrics judge(model.surface());
  Comparison result{model.surface().visible_points,
                    judge.pixels(),
                    judge.shade_model(Vec3f(light_x, light_y, light_z)),
                    {},
                    {}};
  std::optional<Error> out_of_reach;
  for (const double share : arguments.heights) {
    Result<std::vector<Entry>> entries = entries_at(share, chosen, model, judge);
    if (!entries) {
      if (entries.error().kind != ErrorKind::geometry) return std::unexpected(entries.error());
      out_of_reach = entries.error();
      result.remarks.push_back(
          cat("left out height ", share, ", at a width of 100 mm: ", out_of_reach->message()));
      continue;
    }
    std::move(entries->begin(), entries->end(), std::back_inserter(result.entries));
  }
  if (result.entries.empty() && out_of_reach) return std::unexpected(*out_of_reach);
  return result;
}

std::string fixed(double value, int digits) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, digits);
  return {text, end.ptr};
}

std::string percent(double share) {
  return cat(100 * share, " %");
}

std::vector<std::string> lines_of(const Entry& e) {
  const Measures& m = e.measures;
  return {cat(name_of(e.method), ", ", percent(e.height)),
          cat("shading ", fixed(m.shading, 3), "  angle ", fixed(m.angle_deg, 1)),
          cat("detail ", fixed(m.detail[0], 3), " ", fixed(m.detail[1], 3), " ", fixed(m.detail[2], 3)),
          cat("order ", fixed(m.order, 3), "  used ", fixed(m.height_used, 2))};
}

std::vector<std::byte> sheet_of(const Comparison& comparison, std::size_t methods_per_height) {
  std::vector<std::vector<SheetCell>> rows;
  for (std::size_t i = 0; i < comparison.entries.size(); ++i) {
    if (i % methods_per_height == 0)
      rows.push_back({{comparison.model, {"the model", cat(comparison.visible_points, " points")}}});
    rows.back().push_back({comparison.entries[i].picture, lines_of(comparison.entries[i])});
  }
  return write_png(make_sheet(rows));
}

void print_table(const Comparison& comparison) {
  std::printf("%zu visible points, %zu pixels measured\n\n", comparison.visible_points,
              comparison.measured_pixels);
  std::printf(
      "height  method    shading  angle  detail 1, 2, 4 px    order   halo  steep  used  jump   rim\n");
  for (const Entry& e : comparison.entries) {
    const Measures& m = e.measures;
    std::printf("%5.4g%%  %-8s  %7.4f  %5.2f  %5.3f %5.3f %5.3f   %6.3f  %5.3f  %5.3f  %4.2f  %4.2f  %4.2f\n",
                100 * e.height, std::string(name_of(e.method)).c_str(), m.shading, m.angle_deg, m.detail[0],
                m.detail[1], m.detail[2], m.order, m.halo, m.steep_share, m.height_used, m.jump_step,
                m.rim_step);
  }
}

void print_json(const Comparison& comparison) {
  nlohmann::json entries = nlohmann::json::array();
  for (const Entry& e : comparison.entries) {
    const Measures& m = e.measures;
    entries.push_back({{"method", name_of(e.method)},
                       {"height", e.height},
                       {"shading", m.shading},
                       {"angle_deg", m.angle_deg},
                       {"detail", m.detail},
                       {"order", m.order},
                       {"halo", m.halo},
                       {"steep_share", m.steep_share},
                       {"height_used", m.height_used},
                       {"jump_step", m.jump_step},
                       {"rim_step", m.rim_step}});
  }
  const nlohmann::json json{{"visible_points", comparison.visible_points},
                            {"measured_pixels", comparison.measured_pixels},
                            {"reliefs", entries}};
  std::printf("%s\n", json.dump(2).c_str());
}

Result<void> check_arguments(const CompareArguments& arguments) {
  if (arguments.output.empty()) return {};
  if (ending_of(arguments.output) != "png")
    return std::unexpected(Error{ErrorKind::option, arguments.output, {}, "expected a file ending in .png"});
  for (const std::string& input : arguments.scene.paths)
    if (is_same_file(arguments.output, input))
      return std::unexpected(
          Error{ErrorKind::option, arguments.output, {}, "expected different files for input and outputs"});
  return check_writable(arguments.output);
}

Result<void> compare(const CompareArguments& arguments) {
  if (auto ok = check_arguments(arguments); !ok) return ok;
  const Result<std::vector<Method>> chosen = parse_methods(arguments.methods);
  if (!chosen) return std::unexpected(chosen.error());
  set_thread_count(arguments.threads);
  Progress progress(progress_bar(arguments.is_quiet));
  Result<Comparison> comparison = compare_all(arguments, *chosen, progress);
  progress.finish();
  if (!comparison) {
    if (comparison.error().input.empty()) comparison.error().input = joined(arguments.scene.paths);
    return std::unexpected(comparison.error());
  }
  if (!arguments.output.empty()) {
    const OutputFile file{arguments.output, sheet_of(*comparison, chosen->size())};
    if (auto ok = write_files({&file, 1}); !ok) return ok;
  }
  for (const std::string& remark : comparison->remarks) std::fprintf(stderr, "%s\n", remark.c_str());
  arguments.is_json ? print_json(*comparison) : print_table(*comparison);
  return {};
}

}  // namespace

void add_compare(CLI::App& program, Result<void>& result) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App& command = *program.add_subcommand("compare", "Measure reliefs of one scan by several methods");
  add_scene_flags(command, arguments->scene);
  command.add_option("-o,--output", arguments->output, "contact sheet with the measures beneath")
      ->type_name("SHEET.png");
  command
      .add_option("--height", arguments->heights,
                  "heights, as fractions of the width [0.0001 to 1]; default 0.0125,0.025,0.05")
      ->delimiter(',')
      ->check(CLI::Range(1e-4, 1.0).description(""))
      ->type_name("FRACTION,...");
  command.add_option("--methods", arguments->methods, cat("of ", method_names(), "; default all"))
      ->delimiter(',')
      ->type_name("NAME,...");
  command.add_option("--threads", arguments->threads, "0 for all [0 to 256]")
      ->check(CLI::Range(0, 256).description(""))
      ->type_name("N")
      ->capture_default_str();
  command.add_flag("--json", arguments->is_json, "print JSON instead of a table");
  command.add_flag("--quiet", arguments->is_quiet, "no progress bar");
  command.callback([arguments, &result] { result = compare(*arguments); });
}

}  // namespace relievo::app::cli
