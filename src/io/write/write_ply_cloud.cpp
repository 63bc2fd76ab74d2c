#include <algorithm>
#include <bit>
#include <cstring>

#include "relievo/io/read.h"
#include "relievo/io/write.h"

namespace relievo {
namespace {

// Float keeps seven digits: enough unless most of them tell where the cloud is rather than its shape.
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
  header += "element vertex " + std::to_string(cloud.size()) + "\n";
  for (const char* name : {"x", "y", "z"}) {
    header += std::string("property ") + (is_double ? "double " : "float ") + name + "\n";
  }
  for (const char* name : {"nx", "ny", "nz"}) {
    if (cloud.has_normals()) header += std::string("property float ") + name + "\n";
  }
  return header + "end_header\n";
}

// Writes three values in little-endian order; returns what follows them.
template <typename Bits, typename Vector>
std::byte* put(std::byte* to, const Vector& vector) {
  for (const auto value : vector) {
    auto bits = std::bit_cast<Bits>(value);
    if constexpr (std::endian::native == std::endian::big) bits = std::byteswap(bits);
    std::memcpy(to, &bits, sizeof(bits));
    to += sizeof(bits);
  }
  return to;
}

}  // namespace

std::vector<std::byte> write_ply(const Cloud& cloud, std::string_view comment) {
  const bool is_double = needs_double(cloud);
  const std::string header = make_header(cloud, comment, is_double);
  const std::size_t row = (is_double ? 24 : 12) + (cloud.has_normals() ? 12 : 0);
  std::vector<std::byte> bytes(header.size() + row * cloud.size());
  std::memcpy(bytes.data(), header.data(), header.size());
  std::byte* to = bytes.data() + header.size();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    to = is_double ? put<std::uint64_t>(to, cloud.points[i])
                   : put<std::uint32_t>(to, Vec3f(cloud.points[i].cast<float>()));
    if (cloud.has_normals()) to = put<std::uint32_t>(to, cloud.normals[i]);
  }
  return bytes;
}

}  // namespace relievo
