// Makes small TIFF pictures for tests.
#pragma once

#include "support/format_samples.h"

namespace relievo {

inline constexpr int width = 5, height = 4;

struct TiffField {
  std::uint16_t tag, type;
  std::uint32_t count, value;
};

// The tags of a test picture. Tests change some of them.
struct TiffTags {
  std::uint32_t bits = 16, kind = 1, channels = 1, colours = 1;
  std::string no_data = {};
};

// Returns a little-endian TIFF with one strip that consists of the bytes `pixels`.
inline std::string tiff_of(const TiffTags& tags, const std::string& pixels) {
  const bool has_palette = tags.colours == 3;  // a palette has 256 colours
  const std::string palette(has_palette ? 2 * 3 * 256 : 0, '\7');
  const std::string text = tags.no_data.empty() ? palette : padded(tags.no_data + '\0', '\0');
  std::vector<TiffField> fields = {{256, 4, 1, width},
                                   {257, 4, 1, height},
                                   {258, 3, 1, tags.bits},
                                   {259, 3, 1, 1},
                                   {262, 3, 1, tags.colours},
                                   {273, 4, 1, 0},
                                   {277, 3, 1, tags.channels},
                                   {278, 4, 1, height},
                                   {279, 4, 1, static_cast<std::uint32_t>(pixels.size())},
                                   {339, 3, 1, tags.kind}};
  if (tags.channels == 2) {  // then two fields hold two equal 16-bit numbers each
    fields[2].count = fields[9].count = 2;
    fields[2].value *= 65537, fields[9].value *= 65537;
    fields.insert(fields.end() - 1, {338, 3, 1, 2});
  }
  if (has_palette) fields.insert(fields.end() - 1, {320, 3, 3 * 256, 0});
  if (!tags.no_data.empty()) fields.push_back({42113, 2, static_cast<std::uint32_t>(text.size()), 0});
  const auto data = static_cast<std::uint32_t>(8 + 2 + fields.size() * 12 + 4);
  fields[5].value = data + static_cast<std::uint32_t>(text.size());
  for (TiffField& f : fields)
    if (f.tag == 320 || f.tag == 42113) f.value = data;
  std::string file =
      std::string("II*\0", 4) + raw(std::uint32_t{8}) + raw(static_cast<std::uint16_t>(fields.size()));
  for (const TiffField& f : fields) file += raw(f.tag) + raw(f.type) + raw(f.count) + raw(f.value);
  return file + raw(std::uint32_t{0}) + text + pixels;
}

// Returns the bytes of all pixels. number(i) is the value of pixel i.
template <typename MakeNumber>
std::string pixels_of(MakeNumber&& number) {
  std::string pixels;
  for (int i = 0; i < width * height; ++i) pixels += raw(number(i));
  return pixels;
}

inline std::string whole_tiff() {
  return tiff_of({}, pixels_of([](int i) { return static_cast<std::uint16_t>(i); }));
}

}  // namespace relievo
