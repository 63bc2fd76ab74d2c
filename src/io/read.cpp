#include "relievo/io/read.h"

#include <algorithm>
#include <cmath>

#include "core/lists.h"
#include "io/formats.h"
#include "io/pictures/pictures.h"
#include "io/ply.h"
#include "io/text.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "scan/depth/organised_cloud.h"

namespace relievo {
namespace {

Result<io::RawCloud> read_by_format(const io::Source& source) {
  const bool is_empty = source.bytes.size() == io::byte_order_mark_size(source.bytes);
  if (!is_empty)
    for (const io::Format& format : io::formats)
      if (format.is_format(source)) return format.read(source);
  return source.error({}, cat("expected a ", readable_formats(), ", found ",
                              is_empty ? "an empty file" : io::foreign_format(source)));
}

// If the cloud is organised, which means that its points are the pixels of a depth camera, smooths it like a
// depth image and adds a remark.
void smooth(io::RawCloud& raw, bool keeps_blur) {
  if (raw.columns == 0) return;
  const std::size_t rows = raw.cloud.size() / raw.columns;
  OrganisedCloud scan{std::move(raw.cloud), raw.columns, keeps_blur};
  const auto smoothed = smooth_organised(scan);
  raw.cloud = std::move(scan.cloud);
  if (!smoothed) return;
  raw.remarks.push_back(cat("an organised cloud of ", raw.columns, " x ", rows, " points, smoothed within ",
                            std::round(smoothed->noise * 100) / 100, " pixels"));
  raw.leave_out(smoothed->blur, "on blurred or ragged outlines of depths; --doubtful keep keeps them");
}

// Depth cameras write 0, 0, 0 where they have not measured anything. A small number of such points may belong
// to the model.
constexpr std::size_t most_at_origin = 16;

// Returns the number of points at 0, 0, 0 that count as not measured. Returns 0 for a mesh, if at most 16
// points are at 0, 0, 0, and if all finite points are there.
std::size_t count_unmeasured(const CloudFile& file) {
  if (!file.mesh.empty()) return 0;
  const std::size_t zeros =
      count_where(file.cloud.size(), [&](std::size_t i) { return file.cloud.points[i].isZero(0); });
  if (zeros <= most_at_origin) return 0;
  const std::size_t finite =
      count_where(file.cloud.size(), [&](std::size_t i) { return file.cloud.points[i].allFinite(); });
  return zeros < finite ? zeros : 0;
}

// Removes points that are not finite or not measured. In a cloud with normals, removes points without a
// normal, too, if they are a minority; otherwise removes all normals. Losing few points is better than losing
// all normals, but losing most points is worse.
void drop_unusable(CloudFile& file) {
  Cloud& cloud = file.cloud;
  file.unmeasured_points = count_unmeasured(file);
  const auto is_finite = [&](std::size_t i) { return cloud.points[i].allFinite(); };
  const auto is_place = [&](std::size_t i) {
    return is_finite(i) && (file.unmeasured_points == 0 || !cloud.points[i].isZero(0));
  };
  const auto has_normal = [&](std::size_t i) { return !cloud.has_normals() || !cloud.normals[i].isZero(0); };
  const std::size_t not_finite = count_where(cloud.size(), [&](std::size_t i) { return !is_finite(i); });
  file.dropped_points = not_finite - std::min(not_finite, file.left_out_points);
  file.dropped_normals =
      count_where(cloud.size(), [&](std::size_t i) { return is_place(i) && !has_normal(i); });
  const std::size_t no_places = not_finite + file.unmeasured_points;
  if (file.dropped_normals > (cloud.size() - no_places) / 2) cloud.normals.clear();
  if (no_places + file.dropped_normals == 0) return;
  std::vector<std::uint8_t> is_usable(cloud.size());
  parallel_for(is_usable.size(), [&](std::size_t i) { is_usable[i] = is_place(i) && has_normal(i); });
  const auto is_kept = [&](std::size_t i) { return is_usable[i] != 0; };
  keep_where(cloud.points, is_kept);
  keep_where(cloud.normals, is_kept);
  keep_where(cloud.colours, is_kept);
  keep_where(cloud.axes, is_kept);
}

constexpr std::uint64_t stl_header_bytes = 84, stl_triangle_bytes = 50;

std::uint64_t big_endian_32(std::string_view bytes, std::size_t at) {
  std::uint64_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

// Estimates the size of a scan, assuming 20 bytes per point. The estimate is more often too large than too
// small. A text with three coordinates has at least 6 bytes per point, usually 20 to 30. An OBJ with two
// triangles per vertex has about 60 bytes per vertex, a glTF 36.
ScanSize estimate(const io::Source& head, std::uint64_t file_bytes) {
  constexpr std::uint64_t bytes_per_point = 20;
  ScanSize size{file_bytes / bytes_per_point, 0, 0};
  for (const io::Format& format : io::formats) {
    if (!format.is_format(head)) continue;
    if (format.content != io::Content::points) size.triangles = 2 * size.points;
    break;
  }
  return size;
}

ScanSize ply_size(const io::PlyHeader& header, std::uint64_t file_bytes) {
  ScanSize size{0, 0, 0, true};
  for (const io::PlyElement& element : header.elements) {
    const bool is_text = header.format == io::PlyFormat::ascii;
    const std::uint64_t row_bytes =
        std::max<std::uint64_t>(1, is_text ? 2 * element.properties.size() : least_row_size(element));
    const std::uint64_t rows = std::min(element.count, file_bytes / row_bytes);
    if (element.name == "vertex") size.points += rows;
    if (element.name == "face") size.triangles += rows;
  }
  return size;
}

// Returns the number of pixels that the beginning of a picture states; 0 if it does not state the number.
std::uint64_t stated_pixels(const io::Source& head) {
  if (io::is_png(head) && head.bytes.size() >= 24)
    return big_endian_32(head.bytes, 16) * big_endian_32(head.bytes, 20);
  if (!io::is_jpeg(head)) return 0;
  const io::JpegHeader header = io::find_jpeg_header(head.bytes);
  return header.width * header.height;
}

// Returns the number of pixels of a picture. A TIFF may state it anywhere in the file, so one pixel per byte
// is assumed.
ScanSize picture_size(const io::Source& head, std::uint64_t file_bytes) {
  const std::uint64_t pixels = stated_pixels(head);
  if (pixels == 0) return {0, 0, file_bytes};
  return {0, 0, std::min({pixels, file_bytes * io::best_packing, std::uint64_t{io::most_pixels}}), true};
}

}  // namespace

Result<CloudFile> read_cloud(std::span<const std::byte> bytes, std::string_view name,
                             const FilesBeside& beside) {
  return read_cloud(bytes, name, ReadOptions{beside});
}

Result<CloudFile> read_cloud(std::span<const std::byte> bytes, std::string_view name,
                             const ReadOptions& options) {
  const io::Source source{{reinterpret_cast<const char*>(bytes.data()), bytes.size()},
                          name,
                          options.beside ? &options.beside : nullptr,
                          options.keeps_doubtful};
  RELIEVO_TRY(auto raw, read_by_format(source));
  smooth(raw, options.keeps_doubtful);
  CloudFile file{.cloud = std::move(raw.cloud),
                 .format = std::move(raw.format),
                 .missing_points = raw.missing_points,
                 .left_out_points = raw.left_out_points,
                 .remarks = std::move(raw.remarks),
                 .mesh = std::move(raw.mesh)};
  const std::size_t points = file.cloud.size();
  drop_unusable(file);
  if (file.cloud.points.empty())
    return source.error({}, points == 0 ? "expected points, found none"
                            : file.left_out_points > 0
                                ? cat("expected points that count, found none: ", file.remarks[0])
                                : cat("expected points, found none with finite coordinates among ", points));
  return file;
}

std::vector<std::string> remarks_on(const CloudFile& file) {
  std::vector<std::string> lines;
  if (file.missing_points > 0)
    lines.push_back(
        cat("the file ends early; ", file.missing_points, " points that its header promises are missing"));
  if (file.dropped_points > 0)
    lines.push_back(cat("left out ", file.dropped_points, " points with coordinates that are not finite"));
  if (file.unmeasured_points > 0)
    lines.push_back(cat("left out ", file.unmeasured_points,
                        " points at 0, 0, 0, as devices write what they have not measured"));
  lines.insert(lines.end(), file.remarks.begin(), file.remarks.end());
  // A mesh keeps points with unusable normals.
  if (file.dropped_normals > 0 && file.mesh.empty())
    lines.push_back(cat("left out ", file.dropped_normals,
                        file.cloud.has_normals() ? " points without a usable normal" : " unusable normals"));
  return lines;
}

ScanSize scan_size(std::span<const std::byte> head, std::string_view name, std::uint64_t file_bytes) {
  const io::Source source{{reinterpret_cast<const char*>(head.data()), head.size()}, name};
  if (is_picture(head)) return picture_size(source, file_bytes);
  if (io::is_ply(source)) {
    if (const auto header = io::read_ply_header(source)) return ply_size(*header, file_bytes);
    return estimate(source, file_bytes);
  }
  for (const io::Format& format : io::formats) {
    if (!format.find_rows || !format.is_format(source)) continue;
    const auto found = format.find_rows(source);
    if (!found) break;
    const std::uint64_t room = file_bytes / std::max<std::size_t>(1, found->records.stride);
    return {std::min(found->records.count, room), 0, 0, true};
  }
  const bool is_binary_stl = io::is_stl(source) && io::has_control_bytes(source.bytes);
  if (is_binary_stl && file_bytes > stl_header_bytes) {
    const std::uint64_t triangles = (file_bytes - stl_header_bytes) / stl_triangle_bytes;
    return {triangles / 2, triangles, 0, true};
  }
  return estimate(source, file_bytes);
}

}  // namespace relievo
