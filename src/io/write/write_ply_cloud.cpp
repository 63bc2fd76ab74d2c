#include <algorithm>

#include "io/write/mesh_bytes.h"
#include "relievo/core/text.h"
#include "relievo/io/read.h"
#include "relievo/io/write.h"

namespace relievo {
namespace {

// Returns whether float is too imprecise. It has seven digits, which suffice unless most of them are needed
// for the cloud's position rather than its shape.
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

template <typename Vector>
std::byte* put_vector(std::byte* to, const Vector& vector) {
  for (const auto value : vector) to = detail::put(to, value);
  return to;
}

}  // namespace

std::vector<std::byte> write_ply(const Cloud& cloud, std::string_view comment) {
  const bool is_double = needs_double(cloud);
  const std::string header = make_header(cloud, comment, is_double);
  const std::size_t row = (is_double ? 24 : 12) + (cloud.has_normals() ? 12 : 0);
  std::vector<std::byte> bytes(header.size() + row * cloud.size());
  std::byte* to = detail::put_text(bytes.data(), header);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    to = is_double ? put_vector(to, cloud.points[i]) : put_vector(to, Vec3f(cloud.points[i].cast<float>()));
    if (cloud.has_normals()) to = put_vector(to, cloud.normals[i]);
  }
  return bytes;
}

}  // namespace relievo
