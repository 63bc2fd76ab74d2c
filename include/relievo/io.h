// Point clouds from the bytes of a file. The file system belongs to the programs: nothing here opens a file.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/mesh.h"
#include "relievo/scan/cloud.h"

namespace relievo {

struct CloudFile {
  Cloud cloud;         // finite points only, at least one; normals are unit length, or absent
  std::string format;  // for people: "PLY binary little endian", "XYZ text, 6 columns with normals"
  std::size_t dropped_points = 0;  // points left out because a coordinate was NaN or infinite
  // Normals of other points that were zero, not finite or missing. Their points are left out, too, unless
  // these are most of the points: then all points stay and the cloud has no normals.
  std::size_t dropped_normals = 0;
  Mesh mesh = {};  // of the file's faces, with points of its own; empty if it has none
};

// Returns the points in `bytes`, and the triangles if it has any. The format is told by the content, then by
// the ending of `name`, else taken as text of numbers. `name` is used in errors, too.
//
// - PLY: ascii, binary little and big endian; x y z, nx ny nz and red green blue of any numeric type, in any
//   order, among any other properties and elements. Of elements after the vertices `face` and `tristrips` are
//   read. Ascii rows begin in lines of their own.
// - OBJ: v, vn and f. Normals of points are those of the corners of f, averaged for each vertex; or one vn
// for
//   each v, where no f names any.
// - STL, binary and ascii: corners at the same place become one point; the file's normals are not used.
// - OFF, with normals (NOFF) and colours (COFF).
// - glTF 2.0, .glb or .gltf with its buffers inside: the triangles of the scene, where its nodes place them.
// - PCD: ascii, binary and binary_compressed; x y z, normal_x normal_y normal_z and rgb.
// - LAS 1.0 to 1.4, not compressed, with colours.
// - XYZ, PTS, text: separators (blank, tab, comma, semicolon) and columns are detected: x y z first; normals
//   where three columns are unit vectors in nine of ten rows; a first line with the number of points (more
//   may follow, but not fewer), comments (#, //) and a line of column names, which then decide, are allowed.
//   Columns that are not needed may hold anything. Numbers have a decimal point, never a comma.
//
// Polygons become fans, which is right for convex ones.
//
// Text may have LF, CRLF or CR, a UTF-8 byte order mark, plus signs, and nan or inf. A number beyond double
// is infinite.
//
// Errors (kind input) name the line or the byte and what was expected there; a file of another format is told
// by its name, "an E57 file". No point with finite coordinates is an error. A header that promises more than
// the bytes hold is an error before anything is allocated for it. Every input ends: no recursion, time linear
// in the bytes.
Result<CloudFile> read_cloud(std::span<const std::byte> bytes, std::string_view name);

// Returns the cloud as binary little-endian PLY with float properties x y z (double when float would lose
// digits that matter, i.e. when the box lies more than 1,000 times its diagonal from the origin, or overflow)
// and float nx ny nz if present. `comment` goes into the header, in one line.
std::vector<std::byte> write_ply(const Cloud& cloud, std::string_view comment = {});

}  // namespace relievo
