// Declares the types and functions that the readers of all formats share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/text.h"
#include "relievo/io/read.h"
#include "relievo/scan/normals.h"

namespace relievo::io {

// The bytes of a file, or of its beginning.
struct Source {
  std::string_view bytes;
  std::string_view name;                // file name, for messages and for its extension
  const FilesBeside* beside = nullptr;  // access to files in the same folder, or null
  bool keeps_doubtful = false;          // see ReadOptions

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

// The lines of a text file. Errors name the line.
class SourceLines : public Lines {
 public:
  // Begins with the file's first line, or after its header.
  explicit SourceLines(const Source& source)
      : Lines(source.bytes, byte_order_mark_size(source.bytes)), source_(source) {}
  SourceLines(const Source& source, std::size_t offset, std::size_t lines_before)
      : Lines(source.bytes, offset, lines_before), source_(source) {}

  const Source& source() const { return source_; }

  // Returns an error in the last returned line.
  std::unexpected<Error> fail(std::string expected) const {
    return source_.error_in_line(number(), std::move(expected));
  }
  // Returns an error for the end of the file, in the line after the last one.
  std::unexpected<Error> fail_at_end(const std::string& expected, const std::string& after = {}) const {
    return source_.error_in_line(number() + 1,
                                 "expected " + expected + ", found the end of the file" + after);
  }

 private:
  const Source& source_;
};

// Describes the splats that are left out, for remark_on_left_out().
inline constexpr std::string_view what_splats_leave_out =
    "of splats that are less than half opaque; --doubtful keep keeps them";

// Returns a remark such as "left out 40 points that the file marks as noise".
std::string remark_on_left_out(std::uint64_t points, std::string_view which);

// The content of a file before unusable points are removed.
struct RawCloud {
  Cloud cloud;         // coordinates may be NaN or infinite; normals are normalised by unit_normal()
  std::string format;  // for messages
  Mesh mesh = {};      // a copy of the same points with the file's triangles; empty without triangles
  std::size_t missing_points = 0;         // number of points that the file promises but does not contain
  std::size_t left_out_points = 0;        // number of points left out by leave_out(); they are NaN
  std::vector<std::string> remarks = {};  // see CloudFile
  std::size_t columns =
      0;  // number of columns of an organised cloud, whose points are row by row; otherwise 0

  // Counts points that the file says to leave out, and adds a remark. `which` describes these points.
  void leave_out(std::size_t points, std::string_view which) {
    if (points == 0) return;
    left_out_points += points;
    remarks.push_back(remark_on_left_out(points, which));
  }
};

// Returns whether the first 4,096 bytes contain a control character that does not occur in text.
bool has_control_bytes(std::string_view bytes);

// Returns whether the file's name ends with `ending` (such as ".obj"), in upper or lower case.
bool has_ending(std::string_view name, std::string_view ending);

}  // namespace relievo::io
