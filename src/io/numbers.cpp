#include "io/numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/lists.h"
#include "io/readers.h"
#include "relievo/core/parallel.h"

namespace relievo::io {
namespace {

template <typename T, bool is_swapped>
void decode(const char* first, std::size_t stride, std::size_t rows, double* values) {
  for (std::size_t i = 0; i < rows; ++i)
    values[i] = static_cast<double>(number_at<T, is_swapped>(first + i * stride));
}

template <bool is_swapped>
Decode decoder(NumberType type) {
  constexpr std::array<Decode, 8> all = {decode<std::int8_t, is_swapped>,  decode<std::uint8_t, is_swapped>,
                                         decode<std::int16_t, is_swapped>, decode<std::uint16_t, is_swapped>,
                                         decode<std::int32_t, is_swapped>, decode<std::uint32_t, is_swapped>,
                                         decode<float, is_swapped>,        decode<double, is_swapped>};
  return all[static_cast<std::size_t>(type)];
}

// Number of rows decoded at a time, so that their columns stay in the cache.
constexpr std::size_t block = 1024;

using Values = std::array<std::array<double, block>, 3>;

void decode_columns(const Records& records, const std::array<RecordColumn, 3>& columns, const char* first,
                    std::size_t rows, Values& values) {
  for (std::size_t c = 0; c < 3; ++c) {
    const RecordColumn& column = columns[c];
    decoder(column.type, records.is_big_endian)(first + column.at, records.stride, rows, values[c].data());
    if (column.scale == 1 && column.shift == 0) continue;
    for (std::size_t i = 0; i < rows; ++i) values[c][i] = column.scale * values[c][i] + column.shift;
  }
}

void decode_block(const Records& records, const char* first, std::size_t rows, Cloud& cloud,
                  std::size_t begin) {
  Values v;
  decode_columns(records, records.position, first, rows, v);
  for (std::size_t i = 0; i < rows; ++i) cloud.points[begin + i] = Vec3(v[0][i], v[1][i], v[2][i]);
  for (std::size_t i = 0; records.left_out && i < rows; ++i)
    if (records.left_out->is_left_out(first + i * records.stride))
      cloud.points[begin + i].setConstant(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; records.axis && i < rows; ++i)
    cloud.axes[begin + i] = records.axis(first + i * records.stride);
  if (records.normal) {
    decode_columns(records, *records.normal, first, rows, v);
    for (std::size_t i = 0; i < rows; ++i)
      cloud.normals[begin + i] = unit_normal(Vec3(v[0][i], v[1][i], v[2][i]));
  }
  if (!records.colour) return;
  decode_columns(records, *records.colour, first, rows, v);
  for (std::size_t i = 0; i < rows; ++i)
    cloud.colours[begin + i] = {as_byte(v[0][i]), as_byte(v[1][i]), as_byte(v[2][i])};
}

}  // namespace

std::size_t size_in_bytes(NumberType type) {
  constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

std::uint8_t as_byte(double value) {
  return value > 0 ? static_cast<std::uint8_t>(std::min(255.0, std::round(value))) : std::uint8_t{0};
}

std::vector<Colour> colours_in_bytes(const std::vector<Vec3f>& values) {
  float largest = 0;
  for (const Vec3f& value : values) largest = std::max(largest, value.maxCoeff());
  if (!(largest <= 65535)) return {};
  const float scale = largest <= 1 ? 255.F : largest <= 255 ? 1.F : 1 / 257.F;
  std::vector<Colour> colours(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    for (Eigen::Index c = 0; c < 3; ++c) {
      const float value = std::clamp(scale * values[i][c], 0.F, 255.F);
      colours[i][static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::lround(value));
    }
  return colours;
}

Decode decoder(NumberType type, bool is_big_endian) {
  const bool is_native = is_big_endian == (std::endian::native == std::endian::big);
  return is_native ? decoder<false>(type) : decoder<true>(type);
}

Cloud sized_cloud(const Records& records, std::size_t points) {
  Cloud cloud;
  cloud.points.resize(points);
  if (records.normal) cloud.normals.resize(points);
  if (records.colour) cloud.colours.resize(points);
  if (records.axis) cloud.axes.resize(points);
  return cloud;
}

void decode_rows(const Records& records, const char* first, std::size_t rows, Cloud& cloud,
                 std::size_t begin) {
  for (std::size_t done = 0; done < rows; done += block)
    decode_block(records, first + done * records.stride, std::min(block, rows - done), cloud, begin + done);
}

std::size_t count_left_out(const Records& records, const char* first, std::size_t rows) {
  if (!records.left_out) return 0;
  return count_where(
      rows, [&](std::size_t i) { return records.left_out->is_left_out(first + i * records.stride); });
}

Cloud decode_all(const Records& records, const char* first) {
  Cloud cloud = sized_cloud(records, records.count);
  parallel_ranges(cloud.size(), block, [&](std::size_t begin, std::size_t end) {
    decode_block(records, first + begin * records.stride, end - begin, cloud, begin);
  });
  return cloud;
}

}  // namespace relievo::io
