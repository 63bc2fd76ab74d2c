#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "cli/commands.h"
#include "cli/flags.h"
#include "cli/terminal.h"
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

// Returns the coordinates as text with ten digits, which geo-referenced coordinates need.
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
  for (const ViewGuess& guess : rank_views(cloud))
    text +=
        cat(text.empty() ? "" : ", then ", guess.name, guess.up.empty() ? "" : cat(" with up ", guess.up));
  return text;
}

void print_line(const char* what, const std::string& value) {
  std::printf("%-10s %s\n", what, on_one_line(value).c_str());
}

Result<void> depth_info(std::span<const std::byte> bytes, const std::string& input) {
  RELIEVO_TRY(const DepthImage image, read_depth_image(bytes, input));
  std::size_t missing = 0;
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (const float v : image.values.pixels) {
    missing += !std::isfinite(v) || v == 0;
    if (std::isfinite(v) && v != 0) low = std::min(low, v), high = std::max(high, v);
  }
  print_line("format", cat(image.format, ", taken as a depth image"));
  print_line("pixels", cat(image.values.width, " x ", image.values.height));
  if (const Vec2& size = image.pixel_size; size.x() > 0) print_line("cells", cat(size.x(), " x ", size.y()));
  print_line("values", low <= high ? cat(low, " to ", high) : "none");
  print_line("missing", cat(missing, " (0 or not finite)"));
  return {};
}

// Returns the bounds of the triangles, or of the points if there are no triangles. Points of a mesh that no
// triangle uses do not count.
Box box_of(const CloudFile& file, const PlacedModel& place) {
  Box box;
  const bool is_mesh = !file.mesh.empty();
  for (const Triangle& triangle : file.mesh.triangles)
    for (const Index i : triangle) box.extend(place(file.mesh.points[i]));
  for (std::size_t i = 0; !is_mesh && i < file.cloud.size(); ++i) box.extend(place(file.cloud.points[i]));
  return box;
}

std::string points_text(const CloudFile& file) {
  const bool is_mesh = !file.mesh.empty();
  std::string text = cat(is_mesh ? file.mesh.points.size() - file.dropped_points : file.cloud.size(),
                         file.dropped_points > 0 ? cat(" (and ", file.dropped_points, " not finite)") : "");
  if (file.unmeasured_points > 0) text += cat(" (and ", file.unmeasured_points, " at 0, 0, 0)");
  if (file.missing_points > 0) text += cat(" (and ", file.missing_points, " beyond the end of the file)");
  if (file.dropped_normals > 0 && file.cloud.has_normals() && !is_mesh)
    text += cat(" (and ", file.dropped_normals, " without a normal)");
  return text;
}

// Prints the position of each model of a scene in the front view.
Result<void> scene_info(const std::vector<std::string>& inputs) {
  RELIEVO_TRY(const Scene scene, read_scene(inputs, {}, {}, nullptr));
  RELIEVO_TRY(const std::vector<PlacedModel> places, place_models(scene, View{}));
  print_line("models", cat(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const CloudFile& file = *scene.models[i].file;
    const Box box = box_of(file, places[i]);
    std::printf("\n%s\n", on_one_line(scene.models[i].name).c_str());
    print_line("format", file.format);
    print_line("points", points_text(file));
    if (!file.mesh.empty()) print_line("triangles", cat(file.mesh.triangles.size()));
    for (const std::string& remark : file.remarks) print_line("note", remark);
    print_line("scale", cat(places[i].scale));
    print_line("from", vector_text(box.min));
    print_line("to", vector_text(box.max));
  }
  return {};
}

Result<void> info_of(std::span<const std::byte> bytes, const std::string& input) {
  RELIEVO_TRY(const std::optional<UnpackedFile> array, unpack_array(bytes, input));
  if (array) return info_of(array->bytes, array->name);
  if (is_picture(bytes)) return depth_info(bytes, input);
  RELIEVO_TRY(const CloudFile file, read_cloud_at(bytes, input));
  const Box box = box_of(file, {});
  print_line("format", file.format);
  print_line("points", points_text(file));
  if (!file.mesh.empty()) print_line("triangles", cat(file.mesh.triangles.size()));
  for (const std::string& remark : file.remarks) print_line("note", remark);
  print_line("normals", normals_text(file.cloud));
  print_line("from", vector_text(box.min));
  print_line("to", vector_text(box.max));
  print_line("size", vector_text(box.size()));
  print_line("spacing", cat(measure_spacing(without_repeated_points(file.cloud)).rho));
  print_line("best view", views_text(file.mesh.empty() ? file.cloud : scatter(file.mesh, 200000)));
  return {};
}

Result<void> info(const std::vector<std::string>& inputs) {
  if (inputs.size() > 1 || is_scene_file(inputs[0])) return scene_info(inputs);
  RELIEVO_TRY(const std::vector<std::byte> bytes, read_file(inputs[0], true));
  return info_of(bytes, inputs[0]);
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
