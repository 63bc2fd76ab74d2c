// Point clouds from the bytes of a file. The file system belongs to the programs: nothing here opens a file.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "relievo/cloud.h"
#include "relievo/error.h"

namespace relievo {

struct CloudFile {
  Cloud cloud;                      // finite points only; normals are unit length, or absent
  std::string format;               // for people: "PLY binary little endian", "XYZ text, 6 columns"
  std::size_t dropped_points = 0;   // points left out because a coordinate was NaN or infinite
  std::size_t dropped_normals = 0;  // normals that were zero or not finite; if any, the point goes too
};

// Returns the point cloud in `bytes`, whose format is told by the content first (PLY's magic word), then by
// the ending of `name` (.obj), else taken as text of numbers. `name` is used in errors, too.
//
// - PLY: ascii, binary little and big endian; x y z and nx ny nz of any numeric type, in any order, among any
//   other properties and elements (colours, faces, lists, tristrips), which are skipped.
// - OBJ: v, vn and f. Normals are taken where the vertices have them: by the corners of f, or one vn per v.
// - XYZ, PTS, text: separators (blank, tab, comma, semicolon) and columns are detected: x y z first; normals
//   where three columns are unit vectors; a first line with the number of points, comments (#, //) and a line
//   of column names are allowed.
//
// Errors (kind input) name the line or the byte and what was expected there. A header that promises more than
// the bytes hold is an error before anything is allocated for it. Every input ends: no recursion, time linear
// in the bytes.
Result<CloudFile> read_cloud(std::span<const std::byte> bytes, std::string_view name);

// Returns the cloud as binary little-endian PLY with float properties x y z (double when float would lose
// digits that matter, i.e. when the box lies more than 1,000 times its diagonal from the origin) and nx ny nz
// if present.
std::vector<std::byte> write_ply(const Cloud& cloud, std::string_view comment = {});

}  // namespace relievo
