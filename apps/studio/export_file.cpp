#include "export_file.h"

#include "relievo/export.h"
#include "relievo/preview.h"
#include "relievo/text.h"
#include "relievo/version.h"

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

ExportedFile export_file(const Solid& solid, const std::string& format, int heightmap_px) {
  if (format == "stl") return ExportedFile{text_of(write_stl(solid)), "model/stl"};
  if (format == "ply") return ExportedFile{text_of(write_ply(solid)), "application/octet-stream"};
  if (format == "obj") return ExportedFile{text_of(write_obj(solid)), "model/obj"};
  if (format == "preview") return ExportedFile{text_of(write_png(render_preview(solid, {}))), "image/png"};
  if (format == "3mf") return {as_3mf(solid), "model/3mf"};
  if (format == "tiff") return {text_of(write_tiff(make_heights_mm(solid, heightmap_px))), "image/tiff"};
  const HeightMap map = make_height_map(solid, heightmap_px);
  const std::pair<std::string, std::string> scale[] = {{"mm_per_pixel", cat(map.mm_per_pixel)},
                                                       {"mm_per_grey", cat(map.mm_per_grey)}};
  return ExportedFile{text_of(write_png(map.image, scale, map.mm_per_pixel)), "image/png"};
}

}  // namespace relievo::studio
