// What the readers of the formats share.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "relievo/io.h"

namespace relievo::io {

struct Source {
  std::string_view bytes;
  std::string_view name;  // for messages

  std::unexpected<Error> error(std::string place, std::string expected) const {
    return std::unexpected(Error{ErrorKind::input, std::string(name), std::move(place), std::move(expected)});
  }
  std::unexpected<Error> error_in_line(std::size_t line, std::string expected) const {
    return error("line " + std::to_string(line), std::move(expected));
  }
  std::unexpected<Error> error_at_byte(std::size_t byte, std::string expected) const {
    return error("byte " + std::to_string(byte), std::move(expected));
  }
};

struct RawCloud {
  Cloud cloud;  // coordinates may be NaN or infinite; each normal is as unit_normal() returns it
  std::string format;
  Mesh mesh = {};  // of the same points, which it holds once more; corners are numbers of them
};

// Readers of one format each; what they return has as many points as the file.
Result<RawCloud> read_ply(const Source& source);
Result<RawCloud> read_obj(const Source& source);
Result<RawCloud> read_text(const Source& source);
Result<RawCloud> read_pcd(const Source& source);
Result<RawCloud> read_las(const Source& source);
Result<RawCloud> read_stl(const Source& source);
Result<RawCloud> read_off(const Source& source);
Result<RawCloud> read_gltf(const Source& source);

// Returns n with unit length, or zero if it has no direction (zero or not finite). A vector that is unit up
// to float rounding is returned as it is, so that writing and reading again changes no bit.
Vec3f unit_normal(const Vec3& n);

// Returns what the file is, "a PCD file", if it is a known format that is not read, or binary data; else
// empty.
std::string foreign_format(const Source& source);

// True for the content, or else the name, of the format.
bool is_pcd(const Source& source);
bool is_las(const Source& source);
bool is_stl(const Source& source);
bool is_off(const Source& source);
bool is_gltf(const Source& source);

// True if a few kilobytes hold bytes that no text has.
bool has_control_bytes(std::string_view bytes);

// True if the first word of the content is one with which lines of OBJ begin.
bool looks_like_obj(std::string_view text);

// True if the file's name ends so, case ignored: ".obj".
bool has_ending(std::string_view name, std::string_view ending);

}  // namespace relievo::io
