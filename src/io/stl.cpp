// STL, binary and ascii: single triangles, of which coincident corners are merged.
#include <algorithm>

#include "io/faces.h"
#include "io/formats.h"
#include "io/numbers.h"
#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

constexpr std::size_t header_size = 84, triangle_size = 50;

// Returns true for a binary file. Some begin with "solid" although the format forbids it, and some text does
// not, so the size decides first, then the zeros that any binary file of less than 800 MB has in its number
// of triangles.
bool is_binary(const Source& source) {
  const std::string_view bytes = source.bytes;
  if (bytes.size() < header_size) return has_control_bytes(bytes);
  const std::uint64_t promised = little<std::uint32_t>(bytes.data() + 80);
  return bytes.size() == header_size + promised * triangle_size || has_control_bytes(bytes);
}

RawCloud as_raw(Mesh mesh, std::string format) {
  weld(mesh);
  std::vector<Triangle> triangles = std::move(mesh.triangles);
  RawCloud raw{Cloud{std::move(mesh.points), {}}, std::move(format)};
  raw.mesh = mesh_over(raw.cloud, std::move(triangles));
  return raw;
}

void add_corner(Mesh& mesh, const Vec3& corner) {
  const auto i = static_cast<Index>(mesh.points.size());
  mesh.points.push_back(corner);
  if (i % 3 == 2) mesh.triangles.push_back({i - 2, i - 1, i});
}

Result<RawCloud> read_binary(const Source& source) {
  if (source.bytes.size() < header_size)
    return source.error_at_byte(
        0, "expected the 84 bytes of a binary STL header, found " + std::to_string(source.bytes.size()));
  const std::uint64_t promised = little<std::uint32_t>(source.bytes.data() + 80);
  const std::size_t room = (source.bytes.size() - header_size) / triangle_size;
  if (promised > room)
    return source.error_at_byte(80, "expected the number of triangles, found " + std::to_string(promised) +
                                        ", and there is room for " + std::to_string(room));
  if (promised == 0) return source.error_at_byte(80, "expected at least one triangle, found 0");
  Mesh mesh;
  mesh.points.reserve(3 * promised);
  mesh.triangles.reserve(promised);
  for (std::size_t t = 0; t < promised; ++t) {
    const char* at = source.bytes.data() + header_size + t * triangle_size + 12;
    for (int corner = 0; corner < 3; ++corner, at += 12)
      add_corner(mesh, Vec3(little<float>(at), little<float>(at + 4), little<float>(at + 8)));
  }
  return as_raw(std::move(mesh), "STL binary");
}

class AsciiReader {
 public:
  explicit AsciiReader(const Source& source)
      : source_(source), lines_(source.bytes, byte_order_mark_size(source.bytes)) {}

  Result<RawCloud> read() {
    while (const auto line = lines_.next()) {
      Words words(*line);
      const std::string_view keyword = words.next();
      Result<void> taken;
      if (equals_ignoring_case(keyword, "vertex")) taken = take_vertex(words);
      if (equals_ignoring_case(keyword, "endfacet")) taken = end_facet();
      if (equals_ignoring_case(keyword, "endsolid")) has_end_ = true;
      if (!taken) return std::unexpected(taken.error());
    }
    if (!has_end_ || mesh_.points.size() % 3 != 0)
      return source_.error_in_line(lines_.number() + 1, "expected endsolid, found the end of the file");
    if (mesh_.triangles.empty())
      return source_.error_in_line(lines_.number(),
                                   "expected at least one facet with three vertices, found none");
    return as_raw(std::move(mesh_), "STL ascii");
  }

 private:
  Result<void> take_vertex(Words& words) {
    Vec3 corner;
    for (double& value : corner) {
      const std::string_view word = words.next();
      const auto number = parse_number(word);
      if (!number) return fail("expected 3 numbers after vertex, found " + in_quotes(word));
      value = *number;
    }
    add_corner(mesh_, corner);
    return {};
  }

  Result<void> end_facet() const {
    if (mesh_.points.size() % 3 == 0) return {};
    return fail(cat("expected 3 vertices in the facet, found ", mesh_.points.size() % 3));
  }

  Result<void> fail(std::string expected) const {
    return source_.error_in_line(lines_.number(), std::move(expected));
  }

  const Source& source_;
  Lines lines_;
  Mesh mesh_;
  bool has_end_ = false;
};

bool is_ascii(std::string_view bytes) {
  bytes.remove_prefix(byte_order_mark_size(bytes));
  return equals_ignoring_case(Words(bytes.substr(0, 64)).next().substr(0, 5), "solid");
}

}  // namespace

// Binary STL has no magic word, but its size follows from its number of triangles.
bool is_stl(const Source& source) {
  if (is_ascii(source.bytes) || has_ending(source.name, ".stl")) return true;
  if (source.bytes.size() < header_size || !has_control_bytes(source.bytes)) return false;
  return source.bytes.size() ==
         header_size + triangle_size * std::uint64_t{little<std::uint32_t>(source.bytes.data() + 80)};
}

Result<RawCloud> read_stl(const Source& source) {
  return is_binary(source) ? read_binary(source) : AsciiReader(source).read();
}

}  // namespace relievo::io
