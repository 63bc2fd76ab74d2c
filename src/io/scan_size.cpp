#include "relievo/io/scan_size.h"

#include <algorithm>

#include "io/formats.h"
#include "io/pictures.h"
#include "io/ply_header.h"

namespace relievo {
namespace {

constexpr std::uint64_t stl_header_bytes = 84, stl_triangle_bytes = 50;

std::uint64_t big_endian_32(std::string_view bytes, std::size_t at) {
  std::uint64_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

// A text of three coordinates has at least 6 bytes per point, usually 20 to 30; an OBJ with two triangles per
// vertex has about 60 bytes per vertex, a glTF 36. 20 bytes per point give too many points rather than too
// few.
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

// Returns the number of pixels of a PNG, which its first chunk states. A TIFF may state it anywhere in the
// file; its size is estimated as one pixel per byte.
ScanSize picture_size(const io::Source& head, std::uint64_t file_bytes) {
  if (!io::is_png(head) || head.bytes.size() < 24) return {0, 0, file_bytes};
  const std::uint64_t pixels = big_endian_32(head.bytes, 16) * big_endian_32(head.bytes, 20);
  return {0, 0, std::min({pixels, file_bytes * io::best_packing, std::uint64_t{io::most_pixels}}), true};
}

}  // namespace

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
