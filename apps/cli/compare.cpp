#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/flags.h"
#include "cli/terminal.h"
#include "common/files.h"
#include "common/output_files.h"
#include "common/wording.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/io/write.h"
#include "relievo/make_relief.h"
#include "relievo/picture/render.h"
#include "relievo/quality/measures.h"
#include "relievo/relief/baseline_grid.h"
#include "relievo/scan/resample.h"

namespace relievo::app::cli {
namespace {

struct CompareArguments {
  SceneArguments scene;
  std::string output;
  std::vector<double> heights{.0125, .025, .05};  // as fractions of the width
  std::vector<std::string> methods;
  int threads = 0;
  bool is_json = false, is_quiet = false;
};

// Width of the reliefs in pictures and messages. Each picture has twice as many pixels as the page shows, so
// that it stays sharp when the page is enlarged.
constexpr double width_mm = 100;
constexpr int longer_side_px = 512;

Result<std::vector<std::string_view>> parse_methods(const std::vector<std::string>& names) {
  const std::vector<std::string_view> all = compared_methods();
  if (names.empty()) return all;
  std::vector<std::string_view> chosen;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(all, name);
    if (found == all.end()) return not_one_of("methods", all, name);
    chosen.push_back(*found);
  }
  return chosen;
}

struct ComparedRelief {
  std::string_view method;
  double height = 0;       // as a fraction of the width
  std::string parameters;  // the parameters of a baseline, see TunedRelief
  Measures measures;
  Image8 picture;  // empty, like Comparison::model, if no page is wanted
};

struct Comparison {
  std::string scan;  // name of the scan as the user typed it
  std::vector<std::string_view> methods;
  std::size_t visible_points = 0, measured_pixels = 0;
  Image8 model;
  std::vector<ComparedRelief> reliefs = {};  // sorted by height, then in the order of `methods`
  std::vector<std::string> remarks = {};
};

// Draws the model and its reliefs with the renderer of the preview and the studio.
class PlatePictures {
 public:
  explicit PlatePictures(std::shared_ptr<const ReliefModel> model)
      : surface_(model->surface()), renderer_(std::move(model)) {
    const Box box = Box::of(surface_.points);
    options_.mm_per_unit = width_mm / box.longer_side();
    options_.is_fine = true;
    const Vec3 plate = options_.mm_per_unit * box.size() + Vec3::Constant(2 * options_.margin_mm);
    const double px_per_mm = longer_side_px / plate.head<2>().maxCoeff();
    options_.width = static_cast<int>(std::lround(px_per_mm * plate.x()));
    options_.height = static_cast<int>(std::lround(px_per_mm * plate.y()));
  }

  // Draws the model without shadows and without darkened hollows. As the model has its full depth, these effects
  // would darken the whole ground.
  Image8 of_model() { return draw(renderer_.original(), false); }

  Image8 of_relief(const Relief& relief) {
    const std::vector<float> heights(relief.heights.begin(), relief.heights.end());
    const std::vector<Vec3f> normals = vertex_normals(surface_, heights);
    return draw({heights, normals}, true);
  }

 private:
  Image8 draw(const Shown& shown, bool has_shadows) {
    options_.has_shadows = has_shadows;
    Picture picture;
    renderer_.render(shown, options_, picture);
    return picture.image;
  }

  const Surface& surface_;
  FrameRenderer renderer_;
  RenderOptions options_;
};

// Makes reliefs of one scan, measures all of them on the same surface, and draws them if a page is wanted.
struct Comparer {
  std::shared_ptr<const ReliefModel> model;
  std::optional<ReliefModel> paper;  // the model for Method::paper, if that method is compared
  ReliefMetrics metrics{model->surface()};
  std::optional<PlatePictures> pictures = {};

  // Makes the relief by the method of that name. A baseline gets its best parameters.
  Result<TunedRelief> relief_by(std::string_view name, double height, double unit_mm) const {
    if (std::ranges::count(baseline_names(), name) != 0)
      return best_baseline(name, {model->surface(), *model->system(), metrics}, height, unit_mm);
    RELIEVO_TRY(const Method method, parse_method(name));
    const ReliefModel& own = method == Method::paper ? *paper : *model;
    RELIEVO_TRY(Relief relief, make_by_method(method, own, height, default_shape(method), unit_mm));
    if (method == Method::paper) relief.heights = resampled(relief.heights, own.surface(), model->surface());
    return TunedRelief{std::move(relief), ""};
  }

  // Appends one relief per method, with a height of `share` times the width. Appends none if one method fails.
  Result<void> add_reliefs(double share, Comparison& comparison) {
    const double width = model->surface().longer_side();
    std::vector<ComparedRelief> reliefs;
    for (const std::string_view name : comparison.methods) {
      RELIEVO_TRY(const TunedRelief made, relief_by(name, share * width, width_mm / width));
      reliefs.push_back({name, share, made.parameters, metrics.measure(made.relief.heights),
                         pictures ? pictures->of_relief(made.relief) : Image8{}});
    }
    std::ranges::move(reliefs, std::back_inserter(comparison.reliefs));
    return {};
  }
};

// Returns the message for a wrong height; empty if the height is right. In this command heights are fractions
// of the width; in the other commands they are lengths. CLI11's own message would not mention this
// difference.
std::string height_error(const std::string& text) {
  if (CLI::Range(1e-4, 1.0)(text).empty()) return {};
  return cat("expected fractions of the width, 0.0001 to 1, found ", text);
}

Result<Comparison> compare_all(const CompareArguments& arguments, const std::vector<std::string_view>& chosen,
                               Progress& progress) {
  RELIEVO_TRY(const SampledView seen, read_sample(arguments.scene, &progress));
  const auto is_chosen = [&](Method method) {
    return std::ranges::find(chosen, name_of(method)) != chosen.end();
  };
  RELIEVO_TRY(ReliefModel model, prepare(*seen.sample.cloud, seen.view, {}, &progress));
  const auto shared = std::make_shared<const ReliefModel>(std::move(model));
  Comparer comparer{shared, {}};
  if (is_chosen(Method::paper)) {
    RELIEVO_TRY(comparer.paper, prepare(*seen.sample.cloud, seen.view.for_paper(), {}, &progress));
  }
  RELIEVO_CHECK(progress.stage("comparison", .85));
  if (!arguments.output.empty()) comparer.pictures.emplace(comparer.model);
  Comparison result{.scan = joined(arguments.scene.paths),
                    .methods = chosen,
                    .visible_points = comparer.model->surface().visible_points,
                    .measured_pixels = comparer.metrics.pixels(),
                    .model = comparer.pictures ? comparer.pictures->of_model() : Image8{}};
  for (const double share : arguments.heights) {
    const Result<void> added = comparer.add_reliefs(share, result);
    if (added) continue;
    if (added.error().kind != ErrorKind::geometry) return std::unexpected(added.error());
    result.remarks.push_back(
        cat("left out height ", share, ", at a width of ", width_mm, " mm: ", added.error().message()));
    if (result.reliefs.empty() && share == arguments.heights.back()) return std::unexpected(added.error());
  }
  return result;
}

void print_table(const Comparison& comparison) {
  std::printf("%zu visible points, %zu pixels measured\n\n", comparison.visible_points,
              comparison.measured_pixels);
  std::printf(
      "height  method         shading  angle  detail 1, 2, 4 px    order   halo  steep  used  jump   rim  "
      "fray: rim, jump  facet  longest\n");
  for (const ComparedRelief& e : comparison.reliefs) {
    const Measures& m = e.measures;
    std::printf(
        "%5.4g%%  %-13s  %7.4f  %5.2f  %5.3f %5.3f %5.3f   %6.3f  %5.3f  %5.3f  %4.2f  %4.2f  %4.2f  %9.2f  "
        "%4.2f  "
        "%5.2f  %7.1f\n",
        100 * e.height, std::string(e.method).c_str(), m.shading, m.angle_deg, m.detail[0], m.detail[1],
        m.detail[2], m.order, m.halo, m.steep_share, m.height_used, m.jump_step, m.rim_step,
        m.silhouette_fray_deg, m.jump_fray_deg, m.facet_angle_deg, m.longest_side);
  }
  std::printf("\nLarger is better for shading, detail, order and used, smaller for the others.\n");
}

void print_json(const Comparison& comparison) {
  nlohmann::json entries = nlohmann::json::array();
  for (const ComparedRelief& e : comparison.reliefs) {
    const Measures& m = e.measures;
    entries.push_back({{"method", e.method},
                       {"height", e.height},
                       {"parameters", e.parameters},
                       {"shading", m.shading},
                       {"angle_deg", m.angle_deg},
                       {"detail", m.detail},
                       {"order", m.order},
                       {"near_order", m.near_order},
                       {"halo", m.halo},
                       {"steep_share", m.steep_share},
                       {"height_used", m.height_used},
                       {"jump_step", m.jump_step},
                       {"rim_step", m.rim_step},
                       {"silhouette_fray_deg", m.silhouette_fray_deg},
                       {"jump_fray_deg", m.jump_fray_deg},
                       {"facet_angle_deg", m.facet_angle_deg},
                       {"longest_side", m.longest_side}});
  }
  const nlohmann::json json{{"visible_points", comparison.visible_points},
                            {"measured_pixels", comparison.measured_pixels},
                            {"reliefs", entries}};
  std::printf("%s\n", json.dump(2).c_str());
}

// The ground of the pictures is transparent, so the page has a neutral grey behind them. Negative margins
// cancel the padding inside the pictures, so that plates and text align. The model stays visible while the
// user scrolls.
constexpr std::string_view style = R"(
:root { color-scheme: light dark; }
body { margin: 2rem; font: 15px/1.45 system-ui, sans-serif; background: #e4e4e4; color: #222; }
th, td { padding: 0 2rem 1.5rem 0; vertical-align: top; text-align: left; font-variant-numeric: tabular-nums; }
thead th { padding-bottom: .3rem; }
img { display: block; max-width: 16rem; max-height: 26rem; margin: -.6rem -.9rem -.3rem; }
td[rowspan] img { position: sticky; top: 1rem; }
@media (prefers-color-scheme: dark) { body { background: #333; color: #ddd; } }
)";

std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto byte = [&](std::size_t i) { return i < bytes.size() ? std::to_integer<unsigned>(bytes[i]) : 0; };
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned bits = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (unsigned k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string picture(const Image8& image, std::string_view description) {
  return cat("<img alt=\"", description, "\" src=\"data:image/png;base64,", base64(write_png(image)), "\">");
}

std::string fixed(double value, int digits) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, digits);
  return {text, end.ptr};
}

std::string cell(const ComparedRelief& relief) {
  const Measures& m = relief.measures;
  const std::string name = cat("Relief by ", relief.method, ", ", 100 * relief.height, " % high");
  return cat("<td>", picture(relief.picture, name), "shading ", fixed(m.shading, 3), ", angle ",
             fixed(m.angle_deg, 1), "°<br>detail ", fixed(m.detail[0], 3), ", ", fixed(m.detail[1], 3), ", ",
             fixed(m.detail[2], 3), "<br>order ", fixed(m.order, 3), ", used ", fixed(m.height_used, 2),
             "<br>jump ", fixed(m.jump_step, 2), ", rim ", fixed(m.rim_step, 2), "<br>fray ",
             fixed(m.silhouette_fray_deg, 1), "°, at jumps ", fixed(m.jump_fray_deg, 1), "°, facets ",
             fixed(m.facet_angle_deg, 1), "°, longest side ", fixed(m.longest_side, 1),
             relief.parameters.empty() ? "" : "<br>", relief.parameters, "</td>\n");
}

std::string table(const Comparison& comparison) {
  const std::size_t columns = comparison.methods.size(), rows = comparison.reliefs.size() / columns;
  std::string html = "<table>\n<thead><tr><th>Height<th>Model";
  for (const std::string_view method : comparison.methods) html += cat("<th>", method);
  html += "</thead>\n";
  for (std::size_t row = 0; row < rows; ++row) {
    const auto first = comparison.reliefs.begin() + static_cast<std::ptrdiff_t>(row * columns);
    html += cat("<tr><th>", 100 * first->height, " %</th>");
    // The model is the same for all heights, so it is embedded once.
    if (row == 0) html += cat("<td rowspan=", rows, ">", picture(comparison.model, "The model"), "</td>\n");
    for (std::size_t i = 0; i < columns; ++i) html += cell(*(first + static_cast<std::ptrdiff_t>(i)));
  }
  return html + "</table>\n";
}

// Returns a page in one HTML file, with a row for each height and a column for each method. The page needs no
// other file.
std::string comparison_page(const Comparison& comparison) {
  const std::string title = cat("Reliefs of ", escaped_markup(comparison.scan));
  std::string html = cat(
      "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>", title, "</title><style>", style,
      "</style>\n<h1>", title, "</h1>\n<p>", comparison.visible_points, " visible points, ",
      comparison.measured_pixels,
      " pixels measured. Heights are shares of the width. The reliefs are better the larger shading, detail, "
      "order and used are, and the smaller all others are.</p>\n");
  for (const std::string& remark : comparison.remarks)
    html += cat("<p>", escaped_markup(as_sentence(remark)), "</p>\n");
  return html + table(comparison) + "</html>\n";
}

Result<void> compare(const CompareArguments& arguments) {
  if (!arguments.output.empty())
    RELIEVO_CHECK(check_output(arguments.output, {".html"}, arguments.scene.paths));
  RELIEVO_TRY(const std::vector<std::string_view> chosen, parse_methods(arguments.methods));
  set_thread_count(arguments.threads);
  Progress progress(progress_bar(arguments.is_quiet));
  Result<Comparison> comparison =
      naming(joined(arguments.scene.paths), compare_all(arguments, chosen, progress));
  progress.finish();
  if (!comparison) return std::unexpected(comparison.error());
  if (!arguments.output.empty()) {
    const OutputFile file{arguments.output, bytes_of(comparison_page(*comparison))};
    RELIEVO_CHECK(write_files({&file, 1}));
  }
  for (const std::string& remark : comparison->remarks)
    std::fprintf(stderr, "%s\n", on_one_line(remark).c_str());
  arguments.is_json ? print_json(*comparison) : print_table(*comparison);
  return {};
}

}  // namespace

void add_compare(CLI::App& program, Result<void>& result) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App& command = *program.add_subcommand("compare", "Measure reliefs of one scan by several methods");
  const std::vector<std::string_view> names = compared_methods();
  add_scene_flags(command, arguments->scene);
  command.add_option("-o,--output", arguments->output, "page with pictures and measures side by side")
      ->type_name("PAGE.html");
  command
      .add_option("--height", arguments->heights,
                  "heights, as fractions of the width [0.0001 to 1]; default 0.0125,0.025,0.05")
      ->delimiter(',')
      ->check(CLI::Validator(height_error, ""))
      ->type_name("FRACTION,...");
  command
      .add_option("--methods", arguments->methods,
                  cat("of ", joined({names.begin(), names.end()}), "; default all"))
      ->delimiter(',')
      ->type_name("NAME,...");
  add_number(command, "--threads", arguments->threads, CLI::Range(0, 256), "0 for all [0 to 256]");
  command.add_flag("--json", arguments->is_json, "print JSON instead of a table");
  command.add_flag("--quiet", arguments->is_quiet, "no progress bar");
  command.callback([arguments, &result] { result = compare(*arguments); });
}

}  // namespace relievo::app::cli
