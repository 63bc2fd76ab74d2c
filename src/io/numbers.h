// Decodes columns of binary numbers to double, and points in rows of equal size, as in binary PLY, PCD and
// LAS. Rows can be decoded independently of each other.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "relievo/scan/cloud.h"

namespace relievo::io {

enum class NumberType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_in_bytes(NumberType type);

// Returns the integer from 0 to 255 that is nearest to the value; 0 for NaN.
std::uint8_t as_byte(double value);

// Returns colours as bytes. The range of the values is taken as 0 to 1, 0 to 255 or 0 to 65535, whichever is
// the smallest that contains the largest value. Returns no colours if the largest value exceeds 65535.
std::vector<Colour> colours_in_bytes(const std::vector<Vec3f>& values);

// Decodes `rows` values that are `stride` bytes apart.
using Decode = void (*)(const char* first, std::size_t stride, std::size_t rows, double* values);

Decode decoder(NumberType type, bool is_big_endian);

// Returns the number of type T at `from`, which need not be aligned. Its bytes are in the machine's order or,
// if `is_swapped`, in the opposite one.
template <typename T, bool is_swapped>
T number_at(const char* from) {
  using Sizes = std::tuple<std::uint8_t, std::uint16_t, std::uint32_t, std::uint64_t>;
  std::tuple_element_t<std::countr_zero(sizeof(T)), Sizes> bits;
  std::memcpy(&bits, from, sizeof bits);
  if constexpr (is_swapped) bits = std::byteswap(bits);
  return std::bit_cast<T>(bits);
}

// Returns the little-endian number of type T at `from`.
template <typename T>
T little(const char* from) {
  return number_at<T, std::endian::native == std::endian::big>(from);
}

struct RecordColumn {
  NumberType type = NumberType::float32;
  std::size_t at = 0;           // byte offset within a row
  double scale = 1, shift = 0;  // the value is scale * number + shift
};

// Decides which rows are left out, according to the file.
struct LeftOutRows {
  std::function<bool(const char* row)> is_left_out;
  std::string_view which;  // for messages, such as "that the file marks as noise"
};

struct Records {
  std::uint64_t offset = 0;  // offset of the first row in the file
  std::uint64_t count = 0;   // number of rows
  std::size_t stride = 0;    // distance between rows in bytes
  bool is_big_endian = false;
  std::array<RecordColumn, 3> position;
  std::optional<std::array<RecordColumn, 3>> normal, colour;  // colours scaled to [0, 255]
  std::optional<LeftOutRows> left_out;                        // the points of these rows become NaN
  std::function<Vec3f(const char* row)> axis;                 // see Cloud::axes; empty if rows have none
};

// The location of rows that can be read in blocks.
struct StreamRecords {
  Records records;
  std::string format;              // for messages
  std::uint64_t faces = 0;         // number of faces of a mesh, which are not read
  bool may_end_early = false;      // whether a file with fewer rows than promised is read to its end
  std::uint64_t missing_rows = 0;  // number of rows that the file promises but does not contain
};

// Returns a cloud of `points` uninitialised points, with normals and colours if the records have them.
Cloud sized_cloud(const Records& records, std::size_t points);

// Decodes `rows` rows at `first` into the cloud, from point `begin` on. Normals are normalised as by
// unit_normal().
void decode_rows(const Records& records, const char* first, std::size_t rows, Cloud& cloud,
                 std::size_t begin);

std::size_t count_left_out(const Records& records, const char* first, std::size_t rows);

// Decodes all rows, concurrently. `first` points to the first row.
Cloud decode_all(const Records& records, const char* first);

}  // namespace relievo::io
