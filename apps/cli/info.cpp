#include <cstdio>
#include <memory>

#include "commands.h"
#include "files.h"
#include "relievo/io.h"
#include "relievo/normals.h"
#include "relievo/spacing.h"
#include "relievo/text.h"
#include "relievo/view.h"

namespace relievo::cli {
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

Result<void> info(const std::string& input) {
  const Result<std::vector<std::byte>> bytes = read_file(input);
  if (!bytes) return std::unexpected(bytes.error());
  const Result<CloudFile> file = read_cloud(*bytes, input);
  if (!file) return std::unexpected(file.error());
  const Box box = bounds(file->cloud);
  const auto line = [](const char* what, const std::string& value) {
    std::printf("%-10s %s\n", what, value.c_str());
  };
  line("format", file->format);
  line("points", cat(file->cloud.size(),
                     file->dropped_points ? cat(" (and ", file->dropped_points, " not finite)") : ""));
  if (!file->mesh.empty()) line("triangles", cat(file->mesh.triangles.size()));
  line("normals", normals_text(file->cloud));
  line("from", vector_text(box.min));
  line("to", vector_text(box.max));
  line("size", vector_text(box.size()));
  line("spacing", cat(measure_spacing(file->cloud).rho));
  line("best view", views_text(file->cloud));
  return {};
}

}  // namespace

void add_info(CLI::App& program, Result<void>& result) {
  const auto input = std::make_shared<std::string>();
  CLI::App& command = *program.add_subcommand("info", "Tell what is in a scan");
  command
      .add_option("input", *input, "point cloud (PLY, PCD, LAS, XYZ, PTS) or mesh (PLY, STL, OBJ, OFF, GLB)")
      ->required()
      ->type_name("INPUT");
  command.callback([input, &result] { result = info(*input); });
}

}  // namespace relievo::cli
