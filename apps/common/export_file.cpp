#include "export_file.h"

#include "relievo/core/text.h"
#include "relievo/core/version.h"
#include "relievo/picture/height_map.h"
#include "relievo/preview.h"

namespace relievo::studio {
namespace {

std::string text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// As `relievo make` writes it.
std::string as_3mf(const Solid& solid) {
  const std::pair<std::string, std::string> metadata[] = {{"Title", "Relief"},
                                                          {"Application", cat("relievo ", version)}};
  return text_of(write_3mf(solid, metadata));
}

}  // namespace

bool is_format(const std::string& format) {
  for (const char* known : {"stl", "3mf", "ply", "obj", "heightmap", "tiff", "preview"})
    if (format == known) return true;
  return false;
}

ExportedFile export_file(const MadeRelief& made, const std::string& format, int heightmap_px) {
  const Solid& solid = made.solid;
  if (format == "stl") return {text_of(write_stl(solid)), "model/stl"};
  if (format == "ply") return {text_of(write_ply(solid)), "application/octet-stream"};
  if (format == "obj") return {text_of(write_obj(solid)), "model/obj"};
  if (format == "preview") return {text_of(write_png(render_preview(solid, {}))), "image/png"};
  if (format == "3mf") return {as_3mf(solid), "model/3mf"};
  const bool is_tiff = format == "tiff";
  return {text_of(height_map_file(made, {heightmap_px, is_tiff})), is_tiff ? "image/tiff" : "image/png"};
}

std::vector<std::byte> height_map_file(const MadeRelief& made, const HeightMapOrder& order) {
  const auto& wrap = made.report.wrap;
  const Solid& solid = wrap ? made.flat : made.solid;
  if (order.is_tiff) {
    HeightsMm heights = make_heights_mm(solid, order.longer_side_px);
    if (wrap) heights.note = cat("diameter_mm=", wrap->diameter_mm, ", mm_per_degree=", wrap->mm_per_degree);
    return write_tiff(heights);
  }
  const HeightMap map = make_height_map(solid, order.longer_side_px);
  std::vector<std::pair<std::string, std::string>> scale{{"mm_per_pixel", cat(map.mm_per_pixel)},
                                                         {"mm_per_grey", cat(map.mm_per_grey)}};
  if (order.unit == LengthUnit::inch) {
    scale.emplace_back("in_per_pixel", cat(map.mm_per_pixel / mm_per_inch));
    scale.emplace_back("in_per_grey", cat(map.mm_per_grey / mm_per_inch));
  }
  if (wrap) {
    scale.emplace_back("diameter_mm", cat(wrap->diameter_mm));
    scale.emplace_back("mm_per_degree", cat(wrap->mm_per_degree));
  }
  return write_png(map.image, scale, map.mm_per_pixel);
}

}  // namespace relievo::studio
