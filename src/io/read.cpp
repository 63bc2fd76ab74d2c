#include <array>
#include <cmath>

#include "io/readers.h"
#include "io/text.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace io {

Vec3f unit_normal(const Vec3& n) {
  if (!n.allFinite() || n.isZero(0)) return Vec3f::Zero();
  const Vec3f rounded = n.cast<float>();
  const double rounding = 1e-6;  // of the squared length of three floats, with some room
  if (std::abs(rounded.cast<double>().squaredNorm() - 1) <= rounding) return rounded;
  return (n / n.cwiseAbs().maxCoeff()).normalized().cast<float>();  // scaled first: squares may overflow
}

}  // namespace io

namespace {

bool is_ply(std::string_view text) {
  const std::string_view magic = "ply";
  if (!text.starts_with(magic)) return false;
  return text.size() == magic.size() ||
         std::string_view(" \t\r\n").find(text[magic.size()]) != std::string_view::npos;
}

struct Format {
  bool (*is_format)(const io::Source&);
  Result<io::RawCloud> (*read)(const io::Source&);
};

constexpr std::array<Format, 5> formats = {{{io::is_pcd, io::read_pcd},
                                            {io::is_las, io::read_las},
                                            {io::is_gltf, io::read_gltf},
                                            {io::is_off, io::read_off},
                                            {io::is_stl, io::read_stl}}};

Result<io::RawCloud> read_by_format(const io::Source& source) {
  const std::string_view text = source.bytes.substr(io::byte_order_mark_size(source.bytes));
  const std::string readable =
      "expected a point cloud (PLY, PCD, LAS, XYZ, PTS) or a mesh (PLY, STL, OBJ, OFF, glTF), found ";
  if (text.empty()) return source.error({}, readable + "an empty file");
  if (is_ply(text)) return io::read_ply(source);
  for (const auto& [is_format, read] : formats)
    if (is_format(source)) return read(source);
  if (const std::string what = io::foreign_format(source); !what.empty())
    return source.error({}, readable + what);
  if (io::has_ending(source.name, ".obj") || io::looks_like_obj(text)) return io::read_obj(source);
  return io::read_text(source);
}

template <typename IsBad>
std::size_t count_points(std::size_t n, const IsBad& is_bad) {
  const auto count = [&](std::size_t begin, std::size_t end) {
    std::size_t bad = 0;
    for (std::size_t i = begin; i < end; ++i) bad += is_bad(i) ? 1 : 0;
    return bad;
  };
  return parallel_reduce(n, std::size_t{0}, count, std::plus<>());
}

// Keeps the order of the points that stay.
template <typename IsBad>
void remove_points(Cloud& cloud, const IsBad& is_bad) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (is_bad(i)) continue;
    cloud.points[kept] = cloud.points[i];
    if (cloud.has_normals()) cloud.normals[kept] = cloud.normals[i];
    if (cloud.has_colours()) cloud.colours[kept] = cloud.colours[i];
    ++kept;
  }
  cloud.points.resize(kept);
  if (cloud.has_normals()) cloud.normals.resize(kept);
  if (cloud.has_colours()) cloud.colours.resize(kept);
}

// A few points without a normal are not worth losing all normals, nor a few normals losing all other points.
void drop_unusable(CloudFile& file) {
  Cloud& cloud = file.cloud;
  const auto is_finite = [&](std::size_t i) { return cloud.points[i].allFinite(); };
  const auto has_normal = [&](std::size_t i) { return !cloud.has_normals() || !cloud.normals[i].isZero(0); };
  file.dropped_points = count_points(cloud.size(), [&](std::size_t i) { return !is_finite(i); });
  file.dropped_normals =
      count_points(cloud.size(), [&](std::size_t i) { return is_finite(i) && !has_normal(i); });
  const std::size_t finite_points = cloud.size() - file.dropped_points;
  if (file.dropped_normals > finite_points / 2) cloud.normals.clear();
  if (file.dropped_points + file.dropped_normals == 0) return;
  remove_points(cloud, [&](std::size_t i) { return !is_finite(i) || !has_normal(i); });
}

}  // namespace

Result<CloudFile> read_cloud(std::span<const std::byte> bytes, std::string_view name) {
  const io::Source source{{reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name};
  auto raw = read_by_format(source);
  if (!raw) return std::unexpected(std::move(raw.error()));
  CloudFile file{std::move(raw->cloud), std::move(raw->format), 0, 0, std::move(raw->mesh)};
  const std::size_t points = file.cloud.size();
  drop_unusable(file);
  if (file.cloud.points.empty()) {
    return source.error(
        {}, "expected points, found none with finite coordinates among " + std::to_string(points));
  }
  return file;
}

}  // namespace relievo
