#include "common/export_file.h"

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>

#include "common/files.h"
#include "relievo/core/choice.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"
#include "relievo/io/write.h"

namespace relievo::app {
namespace {

std::vector<std::byte> as_3mf(const Solid& solid) {
  const std::pair<std::string, std::string> metadata[] = {{"Title", "Relief"},
                                                          {"Application", cat("relievo ", version)}};
  return write_3mf(solid, metadata);
}

constexpr std::array<FileFormat, 7> formats{
    {{"stl", ".stl", "model/stl", "STL", "printing and milling, in millimetres", write_stl},
     {"3mf", ".3mf", "model/3mf", "3MF", "printing, with units", as_3mf},
     {"ply", ".ply", "application/octet-stream", "PLY", "smaller than STL: corners are shared", write_ply},
     {"obj", ".obj", "model/obj", "OBJ", "as text, for 3D programs", write_obj},
     {"heightmap", "-heights.png", "image/png", "Height map", "16-bit PNG for CNC and engraving"},
     {"tiff", "-heights.tif", "image/tiff", "Heights in mm", "32-bit TIFF"},
     {"preview", ".png", "image/png", "Picture", "front and oblique view"}}};

}  // namespace

std::span<const FileFormat> file_formats() {
  return formats;
}

Result<const FileFormat*> find_format(std::string_view name) {
  std::vector<std::string_view> names;
  for (const FileFormat& format : file_formats()) {
    if (format.name == name) return &format;
    names.push_back(format.name);
  }
  return not_one_of("format", names, name);
}

const FileFormat* find_solid_format(std::string_view ending) {
  const Result<const FileFormat*> format = find_format(ending);
  return format && (*format)->write_solid ? *format : nullptr;
}

std::vector<std::string_view> solid_endings() {
  std::vector<std::string_view> endings;
  for (const FileFormat& format : formats)
    if (format.write_solid) endings.push_back(format.ending);
  return endings;
}

nlohmann::json format_list() {
  nlohmann::json list = nlohmann::json::array();
  for (const FileFormat& format : formats)
    list.push_back({{"name", format.name},
                    {"label", format.label},
                    {"use", format.use},
                    {"ending", format.ending},
                    {"type", format.type}});
  return list;
}

Image8 preview_of(const MadeRelief& made, PreviewOptions options) {
  const bool is_lithophane = made.report.form == Form::lithophane;
  if (is_lithophane && options.material == Material::plaster) options.material = Material::porcelain;
  const std::optional<ReliefReport::Wrapped>& wrap = made.report.wrap;
  if (wrap && (wrap->is_inside || is_lithophane)) options.flat = &made.flat;
  constexpr double half_turn_deg = 180;
  if (!wrap || !wrap->is_inside || wrap->turn_deg <= half_turn_deg)
    return render_preview(made.solid, options);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : made.solid.points) {
    const double across = wrap->across.dot(p.head<2>());
    low = std::min(low, across), high = std::max(high, across);
  }
  options.nearest_mm = (high - low) / 2;  // cuts at the wrap's axis, and shows only the farther half
  return render_preview(made.solid, options);
}

Result<ExportedFile> export_file(const MadeRelief& made, const FileFormat& format, const ExportOrder& order) {
  const auto bytes = [&]() -> Result<std::vector<std::byte>> {
    if (format.write_solid) return format.write_solid(made.solid);
    if (format.name == "preview") return write_png(preview_of(made, {.material = order.material}));
    RELIEVO_TRY(HeightMapFile map, height_map_file(made, order.map));
    return std::move(map.bytes);
  };
  RELIEVO_TRY(const std::vector<std::byte> content, bytes());
  return ExportedFile{std::string(text_in(content)), std::string(format.type)};
}

}  // namespace relievo::app
