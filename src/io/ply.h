// Reads the parts of a PLY file: the header, and the body with the rows of vertices and faces, ascii or
// binary.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "io/numbers.h"
#include "io/polygon.h"
#include "io/readers.h"
#include "relievo/core/text.h"
#include "relievo/core/types.h"

namespace relievo::io {

// A property of an element, as declared in the header of a PLY file.
struct PlyProperty {
  std::string_view name;
  NumberType type;                       // type of the value, or of each value of the list
  std::optional<NumberType> count_type;  // type of a list's length, an integer; only for lists

  bool is_list() const { return count_type.has_value(); }
};

struct PlyElement {
  std::string_view name;
  std::uint64_t count = 0;  // number of rows according to the header, which may be wrong
  std::vector<PlyProperty> properties;
  std::size_t line = 0;  // line of its declaration
};

// Returns the smallest possible size of a binary row in bytes: its size if all lists are empty.
std::size_t least_row_size(const PlyElement& element);

// Returns whether any property is a list, so that rows differ in size.
bool has_lists(const PlyElement& element);

enum class PlyFormat { ascii, little_endian, big_endian };

// The header of a PLY file. Its texts are views of the source.
struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t data_offset = 0;  // byte after the header
  std::size_t lines = 0;        // number of lines of the header
};

// Returns the header. Errors name the line.
Result<PlyHeader> read_ply_header(const Source& source);

// Opacities of Gaussian splats are logits: a splat below 0 is less than half opaque.
constexpr bool is_faint(double opacity) {
  return opacity < 0;
}

// The properties of a vertex that are read: x y z; nx ny nz if all three exist; red green blue if all three
// exist. Gaussian splats also have opacity, scale_0 to scale_2 (flat splats only scale_0 and scale_1), and
// rot_0 to rot_3; their colours are f_dc_0 to f_dc_2.
struct VertexColumns {
  static constexpr std::size_t most = 17;
  std::array<bool, most> is_there = {};
  std::array<std::size_t, most> property = {};  // per column: index of the property that is read into it
  bool are_colours_harmonics = false;           // whether the colours are f_dc instead of red, green and blue
  bool keeps_faint = false;                     // whether splats that are less than half opaque are kept

  bool has_normals() const { return is_there[3]; }
  bool has_colours() const { return is_there[6]; }
  bool has_opacity() const { return is_there[9]; }
  bool has_faint(double opacity) const { return has_opacity() && !keeps_faint && is_faint(opacity); }
};

// A file whose header has been read. Faces may come before or after the vertices.
struct PlyBody {
  const Source& source;
  const PlyHeader& header;
  std::span<const PlyElement> before;
  const PlyElement& vertex;
  std::span<const PlyElement> after;
  VertexColumns columns;
};

struct PlyContent {
  Cloud cloud;
  std::size_t faint = 0;  // number of splats that are less than half opaque; their points are NaN
  std::vector<Triangle> triangles;
};

// Return the vertices and faces. Errors: kind input, with the position, for a body that ends early, a word
// that is not a number, and a face with a vertex that does not exist. Bytes after the faces are ignored.
Result<PlyContent> read_ascii_body(const PlyBody& body);
Result<PlyContent> read_binary_body(const PlyBody& body);

// Returns the layout of the rows of vertices without lists. The offset of the first row is 0.
Records vertex_records(const PlyHeader& header, const PlyElement& vertex, const VertexColumns& columns);

// Returns a colour's column: its type, and its scale to [0, 255]. The caller sets its offset.
RecordColumn colour_column(const VertexColumns& columns, NumberType type);

// The list property with the vertices of a face.
struct FaceList {
  std::size_t property;
  FaceKind kind;
};
// Returns the list property of an element; nothing if it has none.
std::optional<FaceList> find_face_list(const PlyElement& element);

// The logarithm of the third scale of splats that are flat discs. This scale is 0; files state only the other
// two scales.
constexpr double no_depth = -std::numeric_limits<double>::infinity();

// Returns the unit vector along which a splat is thinnest. Its sign is arbitrary. `log_scales` are the
// logarithms of its scales, `rotation` is a quaternion w, x, y, z of any length. The result is zero if the
// two smallest scales are nearly equal, which makes the direction arbitrary, or if the rotation is zero or
// not finite.
Vec3f splat_axis(const Vec3& log_scales, const std::array<double, 4>& rotation);

}  // namespace relievo::io
