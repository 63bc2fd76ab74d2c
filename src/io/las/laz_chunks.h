// Finds the chunks of compressed points of a LAZ file, and the items that their points consist of.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "io/las/las_header.h"

namespace relievo::io {

// A part of each point. The numbers of the types are LASzip's.
struct LazItem {
  enum Type : std::uint16_t {
    bytes = 0,
    position = 6,
    time = 7,
    colour = 8,
    wave_packet = 9,
    layered_position = 10,
    layered_colour = 11,
    layered_colour_and_infrared = 12,
    layered_wave_packet = 13,
    layered_bytes = 14
  };
  std::uint16_t type = 0, size = 0, version = 0;
};

struct LazChunk {
  std::uint64_t first_point = 0, points = 0;
  std::string_view bytes;
};

struct LazLayout {
  std::vector<LazItem> items;
  bool is_layered = false;
  std::vector<LazChunk> chunks;
};

// Reads the variable-length record of LASzip and the table of chunks. All chunks lie within the file, and
// together they have the number of points that the header promises. Errors name the byte.
Result<LazLayout> read_laz_layout(const Source& source, const LasHeader& header);

}  // namespace relievo::io
