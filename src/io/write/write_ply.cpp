// Writes binary little-endian PLY: clouds, and solids with float vertices.
#include <algorithm>

#include "io/write/mesh_bytes.h"
#include "relievo/core/length.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"
#include "relievo/io/read.h"
#include "relievo/io/write.h"
#include "relievo/plate/solid.h"

namespace relievo {
namespace {

// Returns whether float is too imprecise for the coordinates. The seven digits of a float suffice, unless the
// cloud is so far from the origin that most digits only describe its position.
bool needs_double(const Cloud& cloud) {
  const Box box = bounds(cloud);
  if (box.is_empty()) return false;
  const double farthest = box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).maxCoeff();
  const bool overflows = farthest > std::numeric_limits<float>::max();
  return overflows || box.centre().norm() > 1000 * box.diagonal();
}

std::string make_header(const Cloud& cloud, std::string_view comment, bool is_double) {
  std::string line(comment);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  if (!line.empty()) header += "comment " + line + "\n";
  header += cat("element vertex ", cloud.size(), "\n");
  for (const char* name : {"x", "y", "z"})
    header += cat("property ", is_double ? "double " : "float ", name, "\n");
  for (const char* name : {"nx", "ny", "nz"})
    if (cloud.has_normals()) header += cat("property float ", name, "\n");
  return header + "end_header\n";
}

constexpr std::size_t vertex_size = 12, colour_size = 3, face_size = 13;

std::string header(const Solid& solid) {
  return cat(
      "ply\nformat binary_little_endian 1.0\ncomment relievo ", version, ", unit ", name_of(solid.unit),
      "\nelement vertex ", solid.points.size(), "\nproperty float x\nproperty float y\nproperty float z\n",
      solid.colours.empty() ? "" : "property uchar red\nproperty uchar green\nproperty uchar blue\n",
      "element face ", solid.triangles.size(), "\nproperty list uchar int vertex_indices\nend_header\n");
}

}  // namespace

std::vector<std::byte> write_ply(const Cloud& cloud, std::string_view comment) {
  const bool is_double = needs_double(cloud);
  const std::string header = make_header(cloud, comment, is_double);
  const std::size_t row = (is_double ? 24 : 12) + (cloud.has_normals() ? 12 : 0);
  std::vector<std::byte> bytes(header.size() + row * cloud.size());
  std::byte* to = detail::put_text(bytes.data(), header);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    to = is_double ? detail::put_vector(to, cloud.points[i])
                   : detail::put_vector(to, Vec3f(cloud.points[i].cast<float>()));
    if (cloud.has_normals()) to = detail::put_vector(to, cloud.normals[i]);
  }
  return bytes;
}

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
