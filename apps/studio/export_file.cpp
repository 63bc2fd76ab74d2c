#include "export_file.h"

#include "relievo/preview.h"
#include "relievo/text.h"

namespace relievo::studio {
namespace {

std::string text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

bool is_format(const std::string& format) {
  for (const char* known : {"stl", "ply", "obj", "heightmap", "preview"})
    if (format == known) return true;
  return false;
}

ExportedFile export_file(const Solid& solid, const std::string& format, int heightmap_px) {
  if (format == "stl") return ExportedFile{text_of(write_stl(solid)), "model/stl"};
  if (format == "ply") return ExportedFile{text_of(write_ply(solid)), "application/octet-stream"};
  if (format == "obj") return ExportedFile{text_of(write_obj(solid)), "model/obj"};
  if (format == "preview") return ExportedFile{text_of(write_png(render_preview(solid, {}))), "image/png"};
  const HeightMap map = make_height_map(solid, heightmap_px);
  const std::pair<std::string, std::string> scale[] = {{"mm_per_pixel", cat(map.mm_per_pixel)},
                                                       {"mm_per_grey", cat(map.mm_per_grey)}};
  return ExportedFile{text_of(write_png(map.image, scale, map.mm_per_pixel)), "image/png"};
}

}  // namespace relievo::studio
