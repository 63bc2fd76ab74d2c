#include <algorithm>
#include <array>

#include "io/readers.h"
#include "io/text.h"

namespace relievo::io {
namespace {

struct Format {
  std::string_view mark;  // how the content begins, or how the name ends
  std::string_view what;
};

constexpr std::array<Format, 16> by_magic = {{{"ASTM-E57", "an E57 file"},
                                              {"\x89PNG", "a PNG picture"},
                                              {"\xFF\xD8\xFF", "a JPEG picture"},
                                              {"II*", "a TIFF picture"},
                                              {"MM", "a TIFF picture"},
                                              {"{", "a JSON file"},
                                              {"<", "an XML or HTML file"},
                                              {"#VRML", "a VRML file"},
                                              {"Kaydara FBX", "an FBX file"},
                                              {"\x93NUMPY", "a NumPy file"},
                                              {"%PDF", "a PDF file"},
                                              {"PK\x03\x04", "a ZIP archive"},
                                              {"\x1F\x8B", "a gzip archive"},
                                              {"7z\xBC\xAF", "a 7z archive"},
                                              {"\xFF\xFE", "UTF-16 text"},
                                              {"\xFE\xFF", "UTF-16 text"}}};

constexpr std::array<Format, 12> by_ending = {{{".laz", "a LAZ file"},
                                               {".e57", "an E57 file"},
                                               {".ptx", "a PTX file"},
                                               {".3ds", "a 3DS file"},
                                               {".dxf", "a DXF file"},
                                               {".fbx", "an FBX file"},
                                               {".mtl", "a file of OBJ materials"},
                                               {".step", "a STEP file"},
                                               {".stp", "a STEP file"},
                                               {".tif", "a TIFF picture"},
                                               {".tiff", "a TIFF picture"},
                                               {".ply", "a file that does not begin with the line 'ply'"}}};

}  // namespace

bool has_control_bytes(std::string_view bytes) {
  const auto is_control = [](char c) {
    return static_cast<unsigned char>(c) < ' ' && !is_blank(c) && c != '\n' && c != '\r' && c != '\x1A';
  };
  const std::size_t enough = 4096;
  bytes = bytes.substr(0, enough);
  return std::any_of(bytes.begin(), bytes.end(), is_control);
}

bool has_ending(std::string_view name, std::string_view ending) {
  return name.size() >= ending.size() &&
         equals_ignoring_case(name.substr(name.size() - ending.size()), ending);
}

std::string foreign_format(const Source& source) {
  for (const Format& format : by_magic) {
    if (source.bytes.starts_with(format.mark)) return std::string(format.what);
  }
  for (const Format& format : by_ending) {
    if (has_ending(source.name, format.mark)) return std::string(format.what);
  }
  return has_control_bytes(source.bytes) ? "binary data" : "";
}

}  // namespace relievo::io
