#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "cli/commands.h"
#include "cli/input_flags.h"
#include "common/files.h"
#include "relievo/core/text.h"
#include "relievo/io/read.h"
#include "relievo/scan/depth_image.h"
#include "relievo/scan/normals.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scan/spacing.h"
#include "relievo/scan/view.h"

namespace relievo::app::cli {
namespace {

// Ten digits, for geo-referenced coordinates.
std::string vector_text(const Vec3& v) {
  char text[96];
  std::snprintf(text, sizeof text, "%.10g, %.10g, %.10g", v.x(), v.y(), v.z());
  return text;
}

std::string normals_text(const Cloud& cloud) {
  if (!cloud.has_normals()) return "no (make estimates them)";
  return normals_point_inward(cloud) ? "yes, pointing inwards (make turns them)" : "yes, pointing outwards";
}

std::string views_text(const Cloud& cloud) {
  std::string text;
  for (const ViewGuess& guess : rank_views(cloud)) text += cat(text.empty() ? "" : ", then ", guess.name);
  return text;
}

void print_line(const char* what, const std::string& value) {
  std::printf("%-10s %s\n", what, value.c_str());
}

Result<void> depth_info(std::span<const std::byte> bytes, const std::string& input) {
  const Result<DepthImage> image = read_depth_image(bytes, input);
  if (!image) return std::unexpected(image.error());
  std::size_t missing = 0;
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (const float v : image->values.pixels) {
    missing += !std::isfinite(v) || v == 0;
    if (std::isfinite(v) && v != 0) low = std::min(low, v), high = std::max(high, v);
  }
  print_line("format", cat(image->format, ", taken as a depth image"));
  print_line("pixels", cat(image->values.width, " x ", image->values.height));
  print_line("values", low <= high ? cat(low, " to ", high) : "none");
  print_line("missing", cat(missing, " (0 or not finite)"));
  return {};
}

Box placed_box(const CloudFile& file, const PlacedModel& place) {
  Box box;
  for (const Vec3& p : file.mesh.empty() ? file.cloud.points : file.mesh.points) box.extend(place(p));
  return box;
}

// Prints where each model of a scene stands, seen from the front.
Result<void> scene_info(const std::vector<std::string>& inputs) {
  const Result<SceneInput> input = read_scene(inputs, {}, {}, nullptr);
  if (!input) return std::unexpected(input.error());
  const auto places = place_models(input->scene, View{});
  if (!places) return std::unexpected(places.error());
  print_line("models", cat(places->size()));
  for (std::size_t i = 0; i < places->size(); ++i) {
    const CloudFile& file = *input->scene.models[i].file;
    const Box box = placed_box(file, (*places)[i]);
    std::printf("\n%s\n", input->scene.models[i].name.c_str());
    print_line("format", file.format);
    print_line("points", cat(file.cloud.size()));
    if (!file.mesh.empty()) print_line("triangles", cat(file.mesh.triangles.size()));
    print_line("scale", cat((*places)[i].scale));
    print_line("from", vector_text(box.min));
    print_line("to", vector_text(box.max));
  }
  return {};
}

Result<void> info(const std::vector<std::string>& inputs) {
  const std::string& input = inputs[0];
  if (inputs.size() > 1 || is_scene_file(input)) return scene_info(inputs);
  const Result<std::vector<std::byte>> bytes = read_file(input, true);
  if (!bytes) return std::unexpected(bytes.error());
  if (is_picture(*bytes)) return depth_info(*bytes, input);
  const Result<CloudFile> file = read_cloud(*bytes, input);
  if (!file) return std::unexpected(file.error());
  const Box box = bounds(file->cloud);
  print_line("format", file->format);
  print_line("points", cat(file->cloud.size(),
                           file->dropped_points ? cat(" (and ", file->dropped_points, " not finite)") : ""));
  if (!file->mesh.empty()) print_line("triangles", cat(file->mesh.triangles.size()));
  print_line("normals", normals_text(file->cloud));
  print_line("from", vector_text(box.min));
  print_line("to", vector_text(box.max));
  print_line("size", vector_text(box.size()));
  print_line("spacing", cat(measure_spacing(file->cloud).rho));
  print_line("best view", views_text(file->mesh.empty() ? file->cloud : scatter(file->mesh, 200000)));
  return {};
}

}  // namespace

void add_info(CLI::App& program, Result<void>& result) {
  const auto inputs = std::make_shared<std::vector<std::string>>();
  CLI::App& command = *program.add_subcommand("info", "Tell what is in a scan");
  command
      .add_option("input", *inputs, readable_formats() + "; several, or a scene (JSON): where each stands")
      ->required()
      ->type_name("INPUT");
  command.callback([inputs, &result] { result = info(*inputs); });
}

}  // namespace relievo::app::cli
