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

constexpr std::array<Format, 24> by_magic = {
    {{"# .PCD", "a PCD file"},       {"solid", "an STL file"},
     {"LASF", "a LAS or LAZ file"},  {"ASTM-E57", "an E57 file"},
     {"OFF", "an OFF file"},         {"COFF", "an OFF file"},
     {"NOFF", "an OFF file"},        {"CNOFF", "an OFF file"},
     {"\x89PNG", "a PNG picture"},   {"\xFF\xD8\xFF", "a JPEG picture"},
     {"II*", "a TIFF picture"},      {"MM", "a TIFF picture"},
     {"glTF", "a glTF file"},        {"{", "a JSON file"},
     {"<", "an XML or HTML file"},   {"#VRML", "a VRML file"},
     {"Kaydara FBX", "an FBX file"}, {"\x93NUMPY", "a NumPy file"},
     {"%PDF", "a PDF file"},         {"PK\x03\x04", "a ZIP archive"},
     {"\x1F\x8B", "a gzip archive"}, {"7z\xBC\xAF", "a 7z archive"},
     {"\xFF\xFE", "UTF-16 text"},    {"\xFE\xFF", "UTF-16 text"}}};

constexpr std::array<Format, 17> by_ending = {{{".pcd", "a PCD file"},
                                               {".stl", "an STL file"},
                                               {".las", "a LAS file"},
                                               {".laz", "a LAZ file"},
                                               {".e57", "an E57 file"},
                                               {".ptx", "a PTX file"},
                                               {".off", "an OFF file"},
                                               {".3ds", "a 3DS file"},
                                               {".dxf", "a DXF file"},
                                               {".fbx", "an FBX file"},
                                               {".mtl", "a file of OBJ materials"},
                                               {".step", "a STEP file"},
                                               {".stp", "a STEP file"},
                                               {".gltf", "a glTF file"},
                                               {".tif", "a TIFF picture"},
                                               {".tiff", "a TIFF picture"},
                                               {".ply", "a file that does not begin with the line 'ply'"}}};

// No text has these; a few kilobytes tell.
bool has_control_bytes(std::string_view bytes) {
  const auto is_control = [](char c) {
    return static_cast<unsigned char>(c) < ' ' && !is_blank(c) && c != '\n' && c != '\r' && c != '\x1A';
  };
  const std::size_t enough = 4096;
  bytes = bytes.substr(0, enough);
  return std::any_of(bytes.begin(), bytes.end(), is_control);
}

// Binary STL has no magic word, but its size follows from its number of triangles.
bool is_binary_stl(std::string_view bytes) {
  const std::size_t header = 84, triangle = 50;
  if (bytes.size() < header || !has_control_bytes(bytes)) return false;
  std::size_t triangles = 0;
  for (std::size_t i = header; i-- > header - 4;)
    triangles = triangles << 8 | static_cast<unsigned char>(bytes[i]);
  return bytes.size() == header + triangle * triangles;
}

}  // namespace

bool has_ending(std::string_view name, std::string_view ending) {
  return name.size() >= ending.size() &&
         equals_ignoring_case(name.substr(name.size() - ending.size()), ending);
}

std::string foreign_format(const Source& source) {
  for (const Format& format : by_magic) {
    if (source.bytes.starts_with(format.mark)) return std::string(format.what);
  }
  if (is_binary_stl(source.bytes)) return "an STL file";
  for (const Format& format : by_ending) {
    if (has_ending(source.name, format.mark)) return std::string(format.what);
  }
  return has_control_bytes(source.bytes) ? "binary data" : "";
}

}  // namespace relievo::io
