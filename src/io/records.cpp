#include "io/records.h"

#include <algorithm>
#include <cmath>

#include "io/readers.h"
#include "relievo/core/parallel.h"

namespace relievo::io {
namespace {

constexpr std::size_t block = 1024;  // rows decoded at a time: their columns stay in the cache

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

Cloud sized_cloud(const Records& records, std::size_t points) {
  Cloud cloud;
  cloud.points.resize(points);
  if (records.normal) cloud.normals.resize(points);
  if (records.colour) cloud.colours.resize(points);
  return cloud;
}

void decode_rows(const Records& records, const char* first, std::size_t rows, Cloud& cloud,
                 std::size_t begin) {
  for (std::size_t done = 0; done < rows; done += block)
    decode_block(records, first + done * records.stride, std::min(block, rows - done), cloud, begin + done);
}

Cloud decode_all(const Records& records, const char* first) {
  Cloud cloud = sized_cloud(records, records.count);
  parallel_ranges(cloud.size(), block, [&](std::size_t begin, std::size_t end) {
    decode_block(records, first + begin * records.stride, end - begin, cloud, begin);
  });
  return cloud;
}

}  // namespace relievo::io
