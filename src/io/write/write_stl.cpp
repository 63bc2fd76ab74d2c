// Writes binary STL: a header of 80 bytes, the number of triangles, and 50 bytes for each triangle.
#include <Eigen/Geometry>

#include "io/write/mesh_bytes.h"
#include "relievo/core/length.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/core/version.h"
#include "relievo/io/write.h"
#include "relievo/plate/solid.h"

namespace relievo {
namespace {

constexpr std::size_t header_size = 80, triangle_size = 50;

void put_triangle(std::byte* to, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  // The normal is computed from the rounded corners, because some readers compute the normal from these
  // corners and compare it with the file's.
  const Vec3 normal = (b - a).cast<double>().cross((c - a).cast<double>());
  to = detail::put_vector(to, Vec3f(normal.stableNormalized().cast<float>()));
  for (const Vec3f& corner : {a, b, c}) to = detail::put_vector(to, corner);
  detail::put(to, std::uint16_t{0});
}

}  // namespace

std::vector<std::byte> write_stl(const Solid& solid) {
  const std::size_t n = solid.triangles.size();
  std::vector<std::byte> bytes(header_size + 4 + n * triangle_size);
  // The header must not begin with "solid", because readers would treat the file as text.
  detail::put_text(bytes.data(), cat("relievo ", version, " binary STL, unit ", name_of(solid.unit)));
  detail::put(bytes.data() + header_size, static_cast<std::uint32_t>(n));
  std::byte* const triangles = bytes.data() + header_size + 4;
  parallel_for(n, [&](std::size_t t) {
    const auto corner = [&](std::size_t i) -> Vec3f {
      return solid.points[solid.triangles[t][i]].cast<float>();
    };
    put_triangle(triangles + t * triangle_size, corner(0), corner(1), corner(2));
  });
  return bytes;
}

}  // namespace relievo
