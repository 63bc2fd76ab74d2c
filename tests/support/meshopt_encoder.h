// Compresses attributes as EXT_meshopt_compression does, independently of the library's decoder.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace relievo {

inline std::string bytes_of(std::initializer_list<int> values) {
  std::string bytes;
  for (const int value : values) bytes += static_cast<char>(value);
  return bytes;
}

inline std::string zigzag(int difference) {
  const auto byte = static_cast<std::uint8_t>(difference);
  return bytes_of({(byte & 0x80) != 0 ? ~(byte << 1) : byte << 1});
}

inline std::string text_of(const std::optional<std::vector<std::byte>>& bytes) {
  return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : "nothing";
}

// Element i is the number of bits per difference in a group with the code i.
using Widths = std::array<int, 4>;
inline constexpr Widths widths_0 = {0, 2, 4, 8}, narrow_widths = {0, 1, 2, 4}, wide_widths = {1, 2, 4, 8};

// A group of 16 differences. It is packed with that number of bits per difference which gives the fewest
// bytes.
struct Group {
  int code = -1;
  std::string bytes;
};

inline std::string packed(const std::string& stored, int bits) {
  std::string bytes(static_cast<std::size_t>(2 * bits), '\0'), rest;
  for (int i = 0; i < 16; ++i) {
    const int value = static_cast<unsigned char>(stored[static_cast<std::size_t>(i)]),
              escape = bits == 8 ? 256 : (1 << bits) - 1;
    if (value >= escape) rest += static_cast<char>(value);
    char& byte = bytes[static_cast<std::size_t>(i * bits / 8)];
    byte = static_cast<char>(byte | std::min(value, escape) << (bits == 1 ? i % 8 : 8 - bits - i * bits % 8));
  }
  return bytes + rest;
}

inline Group packed_group(const std::string& stored, const Widths& widths) {
  Group best;
  for (int code = 0; code < 4; ++code) {
    const int bits = widths[static_cast<std::size_t>(code)];
    if (bits == 0 && stored != std::string(16, '\0')) continue;
    const std::string bytes = bits == 0 ? "" : packed(stored, bits);
    if (best.code < 0 || bytes.size() < best.bytes.size()) best = {code, bytes};
  }
  return best;
}

// Returns the differences of one byte column, packed in groups. The column has one byte of each
// element. The last group may be shorter.
inline std::string packed_column(const std::string& differences, const Widths& widths) {
  const std::size_t groups = (differences.size() + 15) / 16;
  std::string codes((groups + 3) / 4, '\0'), bytes;
  for (std::size_t i = 0; i < groups; ++i) {
    std::string stored = differences.substr(16 * i, 16);
    stored.resize(16, '\0');
    const Group group = packed_group(stored, widths);
    codes[i / 4] = static_cast<char>(codes[i / 4] | group.code << 2 * (i % 4));
    bytes += group.bytes;
  }
  return codes + bytes;
}

// Returns the differences of byte number `byte` of each element from the same byte of the previous element.
// The elements are those from `first` up to but not including `end`.
inline std::string differences_of(const std::string& elements, std::size_t stride, std::size_t byte,
                                  std::size_t first, std::size_t end) {
  std::string stored;
  for (std::size_t i = first; i < end; ++i)
    stored += zigzag(elements[i * stride + byte] - elements[(i == 0 ? 0 : i - 1) * stride + byte]);
  return stored;
}

inline std::size_t block_of(std::size_t stride) {
  return std::min<std::size_t>(8192 / stride / 16 * 16, 256);
}

inline std::string compressed_attributes(const std::string& elements, std::size_t stride) {
  const std::size_t count = elements.size() / stride, block = block_of(stride);
  std::string out = "\xA0";
  for (std::size_t first = 0; first < count; first += block)
    for (std::size_t byte = 0; byte < stride; ++byte)
      out += packed_column(differences_of(elements, stride, byte, first, std::min(first + block, count)),
                           widths_0);
  return out + std::string(std::max<std::size_t>(stride, 32) - stride, '\0') + elements.substr(0, stride);
}

}  // namespace relievo
