// Writes OBJ: text, with vertices numbered from 1.
#include <charconv>

#include "io/write/mesh_bytes.h"
#include "relievo/core/length.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"
#include "relievo/io/write.h"
#include "relievo/plate/solid.h"

namespace relievo {
namespace {

// Space for a number and the separator before it. The shortest text of a float has up to 15 characters, an
// index up to 10.
constexpr std::size_t most_per_number = 16, most_per_line = 2 + 3 * most_per_number;

template <typename T>
char* put_line(char* to, char kind, const std::array<T, 3>& numbers) {
  *to++ = kind;
  for (const T x : numbers) {
    *to++ = ' ';
    to = std::to_chars(to, to + most_per_number, x).ptr;
  }
  *to++ = '\n';
  return to;
}

}  // namespace

std::vector<std::byte> write_obj(const Solid& solid) {
  const std::string head = cat("# relievo ", version, ", unit ", name_of(solid.unit), "\n");
  std::vector<std::byte> bytes(head.size() + most_per_line * (solid.points.size() + solid.triangles.size()));
  char* to = reinterpret_cast<char*>(detail::put_text(bytes.data(), head));
  for (const Vec3& p : solid.points) {
    const Vec3f q = p.cast<float>();
    to = put_line<float>(to, 'v', {q.x(), q.y(), q.z()});
  }
  for (const Triangle& t : solid.triangles) to = put_line<Index>(to, 'f', {t[0] + 1, t[1] + 1, t[2] + 1});
  bytes.resize(static_cast<std::size_t>(reinterpret_cast<std::byte*>(to) - bytes.data()));
  return bytes;
}

}  // namespace relievo
