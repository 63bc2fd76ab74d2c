// The types and functions that the readers of all formats share.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "relievo/io/read.h"
#include "relievo/scan/normals.h"

namespace relievo::io {

// The bytes of a file, or of its beginning.
struct Source {
  std::string_view bytes;
  std::string_view name;                // of the file, for messages and for its ending
  const FilesBeside* beside = nullptr;  // the files in the same folder, if they can be had

  std::unexpected<Error> error(std::string place, std::string expected) const {
    return input_error(std::string(name), std::move(place), std::move(expected));
  }
  std::unexpected<Error> error_in_line(std::size_t line, std::string expected) const {
    return error("line " + std::to_string(line), std::move(expected));
  }
  std::unexpected<Error> error_at_byte(std::size_t byte, std::string expected) const {
    return error("byte " + std::to_string(byte), std::move(expected));
  }
};

// The content of a file before unusable points are removed.
struct RawCloud {
  Cloud cloud;         // coordinates may be NaN or infinite; each normal is as unit_normal() returns it
  std::string format;  // for people
  Mesh mesh = {};      // a copy of the same points with the file's triangles; empty if it has none
  std::size_t missing_points = 0;  // promised by the header, beyond the end of the file
};

// Returns true if the first 4,096 bytes contain a control character that no text has.
bool has_control_bytes(std::string_view bytes);

// Returns true if the file's name ends with `ending` (".obj"), in upper or lower case.
bool has_ending(std::string_view name, std::string_view ending);

}  // namespace relievo::io
