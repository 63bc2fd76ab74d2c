#include "io/pictures/pictures.h"

#include <algorithm>
#include <optional>

#include "io/pictures/samples.h"

namespace relievo::io {
namespace {

std::optional<std::uint64_t> number_at(std::string_view bytes, std::uint64_t at, unsigned size,
                                       bool is_big_endian = true) {
  if (at > bytes.size() || bytes.size() - at < size) return std::nullopt;
  return whole_number(bytes.data() + at, size, is_big_endian);
}

// Returns the tag Orientation in the first directory of an Exif segment, which is a TIFF after a mark.
std::optional<int> exif_orientation(std::string_view segment) {
  constexpr std::string_view mark{"Exif\0\0", 6};
  constexpr std::uint64_t orientation_tag = 274, entry_bytes = 12, value_at = 8;
  if (!segment.starts_with(mark)) return std::nullopt;
  const std::string_view tiff = segment.substr(mark.size());
  const bool is_big_endian = tiff.starts_with("MM");
  const std::uint64_t directory = number_at(tiff, 4, 4, is_big_endian).value_or(0),
                      entries = number_at(tiff, directory, 2, is_big_endian).value_or(0);
  for (std::uint64_t i = 0; i < entries; ++i) {
    const std::uint64_t entry = directory + 2 + i * entry_bytes;
    const auto tag = number_at(tiff, entry, 2, is_big_endian);
    if (!tag) return std::nullopt;
    if (*tag != orientation_tag) continue;
    return static_cast<int>(number_at(tiff, entry + value_at, 2, is_big_endian).value_or(1));
  }
  return std::nullopt;
}

// Segments begin with a marker of two bytes. Markers C0 to CF begin frames, except C4, C8 and CC.
constexpr std::uint64_t first_frame = 0xC0, last_frame = 0xCF, exif = 0xE1, begin_of_pixels = 0xDA;

bool is_frame(std::uint64_t marker) {
  return marker >= first_frame && marker <= last_frame && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

}  // namespace

JpegHeader find_jpeg_header(std::string_view bytes) {
  JpegHeader header;
  std::uint64_t at = 2;
  while (true) {
    at = std::min(bytes.find('\xFF', at), bytes.size());  // libjpeg also skips bytes between segments
    while (at + 1 < bytes.size() && bytes[at + 1] == '\xFF') ++at;
    const auto marker = number_at(bytes, at + 1, 1), length = number_at(bytes, at + 2, 2);
    if (!marker || !length || *length < 2 || *marker == begin_of_pixels) return header;
    const std::string_view segment = bytes.substr(at + 4, *length - 2);
    if (*marker == exif) header.orientation = exif_orientation(segment).value_or(header.orientation);
    if (is_frame(*marker)) {
      header.height = number_at(segment, 1, 2).value_or(0);
      header.width = number_at(segment, 3, 2).value_or(0);
      header.channels = number_at(segment, 5, 1).value_or(0);
      return header;
    }
    at += 2 + *length;
  }
}

}  // namespace relievo::io
