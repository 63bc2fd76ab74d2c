// Lists the file formats in which a finished relief can be exported, and makes the files.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/height_map_file.h"
#include "relievo/make_relief.h"
#include "relievo/picture/material.h"
#include "relievo/picture/preview.h"

namespace relievo::app {

struct FileFormat {
  std::string_view name;        // name of the format in the studio's requests
  std::string_view ending;      // appended to a file's name: ".stl", "-heights.png"
  std::string_view type;        // the MIME type
  std::string_view label, use;  // texts for users
  std::vector<std::byte> (*write_solid)(const Solid&) = nullptr;  // null for pictures
};

std::span<const FileFormat> file_formats();

// Returns the format of that name; the pointer is never null. Errors: kind option; the message lists all formats.
Result<const FileFormat*> find_format(std::string_view name);

// Returns the format of solids with that ending, such as "stl"; null if there is none.
const FileFormat* find_solid_format(std::string_view ending);

// Returns the endings of the files of solids: ".stl" and others.
std::vector<std::string_view> solid_endings();

// Returns all formats as a JSON list of objects with name, label, use, ending and type.
nlohmann::json format_list();

struct ExportedFile {
  std::string bytes, type;
};

struct ExportOrder {
  HeightMapOrder map = {{.longer_side_px = 2048}};
  Material material = Material::plaster;  // material of the picture
};

// Returns the relief as a file of that format. With the material plaster, the bytes are those that `relievo
// make` writes. Errors: those of height_map_file().
Result<ExportedFile> export_file(const MadeRelief& made, const FileFormat& format, const ExportOrder& order);

// Returns the picture of a relief. If the material is plaster, a lithophane is drawn with a lamp behind it;
// otherwise it is drawn in the given material. If the relief is on the inside of a wrap, the front view shows
// the relief unrolled. The oblique view cuts open a wrap of more than half a turn.
Image8 preview_of(const MadeRelief& made, PreviewOptions options);

}  // namespace relievo::app
