// Writes binary little-endian PLY with float vertices and triangles.
#include "io/write/mesh_bytes.h"
#include "relievo/core/length.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"
#include "relievo/io/write.h"
#include "relievo/plate/solid.h"

namespace relievo {
namespace {

constexpr std::size_t vertex_size = 12, colour_size = 3, face_size = 13;

std::string header(const Solid& solid) {
  return cat(
      "ply\nformat binary_little_endian 1.0\ncomment relievo ", version, ", unit ", name_of(solid.unit),
      "\nelement vertex ", solid.points.size(), "\nproperty float x\nproperty float y\nproperty float z\n",
      solid.colours.empty() ? "" : "property uchar red\nproperty uchar green\nproperty uchar blue\n",
      "element face ", solid.triangles.size(), "\nproperty list uchar int vertex_indices\nend_header\n");
}

}  // namespace

std::vector<std::byte> write_ply(const Solid& solid) {
  const std::string head = header(solid);
  const std::size_t row = vertex_size + (solid.colours.empty() ? 0 : colour_size);
  const std::size_t vertices_size = solid.points.size() * row;
  std::vector<std::byte> bytes(head.size() + vertices_size + solid.triangles.size() * face_size);
  std::byte* const vertices = detail::put_text(bytes.data(), head);
  std::byte* const faces = vertices + vertices_size;
  parallel_for(solid.points.size(), [&](std::size_t i) {
    std::byte* to = vertices + i * row;
    for (const double x : solid.points[i]) to = detail::put(to, static_cast<float>(x));
    if (solid.colours.empty()) return;
    for (const std::uint8_t c : solid.colours[i]) to = detail::put(to, c);
  });
  parallel_for(solid.triangles.size(), [&](std::size_t t) {
    std::byte* to = detail::put(faces + t * face_size, std::uint8_t{3});
    for (const Index i : solid.triangles[t]) to = detail::put(to, i);
  });
  return bytes;
}

}  // namespace relievo
