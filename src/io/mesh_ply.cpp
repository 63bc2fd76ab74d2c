// Binary little-endian PLY with float vertices and triangles.
#include "io/mesh_bytes.h"
#include "relievo/parallel.h"
#include "relievo/solid.h"
#include "relievo/text.h"
#include "relievo/version.h"

namespace relievo {
namespace {

constexpr std::size_t vertex_size = 12, face_size = 13;

std::string header(const Solid& solid) {
  return cat("ply\nformat binary_little_endian 1.0\ncomment relievo ", version, ", unit mm\nelement vertex ",
             solid.points.size(), "\nproperty float x\nproperty float y\nproperty float z\nelement face ",
             solid.triangles.size(), "\nproperty list uchar int vertex_indices\nend_header\n");
}

}  // namespace

std::vector<std::byte> write_ply(const Solid& solid) {
  const std::string head = header(solid);
  const std::size_t vertices_size = solid.points.size() * vertex_size;
  std::vector<std::byte> bytes(head.size() + vertices_size + solid.triangles.size() * face_size);
  std::byte* const vertices = detail::put_text(bytes.data(), head);
  std::byte* const faces = vertices + vertices_size;
  parallel_for(solid.points.size(), [&](std::size_t i) {
    std::byte* to = vertices + i * vertex_size;
    for (const double x : solid.points[i]) to = detail::put(to, static_cast<float>(x));
  });
  parallel_for(solid.triangles.size(), [&](std::size_t t) {
    std::byte* to = detail::put(faces + t * face_size, std::uint8_t{3});
    for (const Index i : solid.triangles[t]) to = detail::put(to, i);
  });
  return bytes;
}

}  // namespace relievo
