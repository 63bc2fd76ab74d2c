// Lists the file formats in which a finished relief can be exported, and makes the files. Tested by
// tests/cli/cli_height_maps_test.cpp.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/length.h"
#include "relievo/make_relief.h"
#include "relievo/picture/height_map.h"
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

// The options of a height map as typed; empty where the default applies.
struct HeightMapTexts {
  std::string pixel, dpi, bits, area, zero, high;

  bool operator==(const HeightMapTexts&) const = default;
};

struct HeightMapFlag {
  const char *name, *unit, *help;
  std::string HeightMapTexts::*text;
};

// The flags of `make` and `batch` for height maps. The studio's requests use the same names.
inline constexpr std::array<HeightMapFlag, 6> height_map_flags{
    {{"pixel", "MM", "exact size of the height map's pixels, in the place of heightmap-size",
      &HeightMapTexts::pixel},
     {"dpi", "N", "pixels per inch of the height map, in the place of pixel", &HeightMapTexts::dpi},
     {"heightmap-bits", "N", "8 or 16 bits for a grey level; a .tif has millimetres in 32 without this",
      &HeightMapTexts::bits},
     {"heightmap-area", "AREA", "plate, or the relief alone, without margin and rim", &HeightMapTexts::area},
     {"heightmap-zero", "ZERO", "height that is black, or 0 mm: the lowest point, or the ground",
      &HeightMapTexts::zero},
     {"heightmap-high", "GREY", "white, or black for an inverted map: the highest point",
      &HeightMapTexts::high}}};

struct HeightMapOrder : HeightMapOptions {
  int bits = 0;          // bits per pixel: 8 or 16 for greys, 32 for mm; 0: 16 in a PNG, 32 in a TIFF
  bool is_tiff = false;  // false: PNG
  LengthUnit unit = LengthUnit::mm;

  int effective_bits() const { return bits != 0 ? bits : is_tiff ? 32 : 16; }
};

// Parses the texts and stores their values in the order. A length without a unit is in the unit of the order.
// Errors: kind option; they name the flag.
Result<void> take_texts(const HeightMapTexts& texts, HeightMapOrder& order);

// Returns the texts that a JSON object has under the names of the flags. Errors: kind option if a value is
// not a text.
Result<HeightMapTexts> height_map_texts(const nlohmann::json& json);

struct HeightMapFile {
  std::vector<std::byte> bytes;
  nlohmann::json facts;  // size and meaning of the pixels, for the report
};

// Returns the height map as a file that also contains its scale. The relief of a wrap is written unrolled,
// for machines that rotate the workpiece. Errors: kind option if the pixels are too small for the size of the
// solid, or if no part of the solid lies above the zero level.
Result<HeightMapFile> height_map_file(const MadeRelief& made, const HeightMapOrder& order);

// Returns the facts of a HeightMapFile as a line for users.
std::string line_of(const nlohmann::json& height_map);

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
