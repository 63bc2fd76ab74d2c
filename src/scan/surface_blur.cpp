#include "scan/surface_blur.h"

#include <cmath>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

constexpr double most_cells = 1 << 24;  // largest number of cells of the whole grid
// The standard deviation of the blur, in cells. The variances of its three steps add up: linear distribution
// to cells and linear interpolation have 1/6 each; averaging neighbours with weights 1, 2, 1 has 1/2.
const double sigma_in_cells = std::sqrt(5.0 / 6);
constexpr std::size_t grain = 512;  // columns that one task averages

}  // namespace

SurfaceBlur::SurfaceBlur(std::span<const Vec3> points, double sigma) : places_(points.size()) {
  const Box box = Box::of(points);
  double side = sigma / sigma_in_cells;
  // The product may exceed std::size_t, which has 32 bits in WebAssembly, so counts are doubles.
  const auto count = [&](int axis) { return std::floor(box.size()[axis] / side) + 4; };
  while (count(0) * count(1) * count(2) > most_cells) side *= 1.1;
  width_ = static_cast<std::size_t>(count(0));
  parallel_for(points.size(), [&](std::size_t i) {
    // A margin of one cell before the first one provides space for neighbours. So 1 is added to a cell's
    // number after the number was rounded down. If 1 were added first, the floating-point sum could be
    // rounded up to the next whole number.
    const Vec3 from_corner = (points[i] - box.min) / side;
    const Vec3 cell = from_corner.array().floor() + 1, share = from_corner + Vec3::Ones() - cell;
    const auto x = static_cast<std::size_t>(cell.x()), y = static_cast<std::size_t>(cell.y());
    places_[i] = {static_cast<Index>(x + width_ * y), static_cast<int>(cell.z()), share.cast<float>()};
  });
  columns_ = columns_around_points(width_ * static_cast<std::size_t>(count(1)));
}

// Returns the first `count` columns, each with the cells that are needed around the points, and then an empty column.
std::vector<SurfaceBlur::Column> SurfaceBlur::columns_around_points(std::size_t count) const {
  std::vector<Column> filled(count), around(count + 1);
  for (const Place& place : places_)
    for (const std::size_t step : {std::size_t{0}, std::size_t{1}, width_, width_ + 1})
      filled[place.column + step].extend(place.z, place.z + 2);
  for (std::size_t c = 0; c < count; ++c) {
    if (filled[c].is_empty()) continue;
    for (const std::size_t row : {c - width_, c, c + width_})
      for (const std::size_t near : {row - 1, row, row + 1})
        around[near].extend(filled[c].low - 1, filled[c].high + 1);
  }
  for (std::size_t c = 0; c < count; ++c) around[c + 1].first = around[c].first + around[c].size();
  return around;
}

// Calls f(cell, weight) for the eight cells around a position.
template <typename F>
void SurfaceBlur::each_corner(const Place& place, F&& f) const {
  const Vec3f& share = place.share;
  for (int corner = 0; corner < 8; ++corner) {
    const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
    const float weight =
        (x ? share.x() : 1 - share.x()) * (y ? share.y() : 1 - share.y()) * (z ? share.z() : 1 - share.z());
    const std::size_t step = static_cast<std::size_t>(x) + width_ * static_cast<std::size_t>(y);
    f(columns_[place.column + step].cell(place.z + z), weight);
  }
}

// Sets each cell to twice its value plus its neighbours in the columns `step` before and after. The column
// before the first one of a row is the last one of another row. Both are margins whose averages are never
// used.
void SurfaceBlur::average_across(std::size_t step, const Cells& cells, Cells& averages) const {
  const std::size_t last = columns_.size() - 1;
  parallel_for(
      last,
      [&](std::size_t c) {
        const Column& column = columns_[c];
        for (std::size_t i = column.first; i < columns_[c + 1].first; ++i) averages[i] = 2 * cells[i];
        const auto add = [&](const Column& other) {
          for (int z = std::max(column.low, other.low); z < std::min(column.high, other.high); ++z)
            averages[column.cell(z)] += cells[other.cell(z)];
        };
        if (c >= step) add(columns_[c - step]);
        if (c + step < last) add(columns_[c + step]);
      },
      grain);
}

// Sets each cell to twice its value plus its two neighbours in the same column.
void SurfaceBlur::average_along(const Cells& cells, Cells& averages) const {
  parallel_for(
      columns_.size() - 1,
      [&](std::size_t c) {
        const std::size_t begin = columns_[c].first, end = columns_[c + 1].first;
        for (std::size_t i = begin; i < end; ++i) {
          averages[i] = 2 * cells[i];
          if (i > begin) averages[i] += cells[i - 1];
          if (i + 1 < end) averages[i] += cells[i + 1];
        }
      },
      grain);
}

void SurfaceBlur::apply(std::span<Vec2f> values) const {
  Cells cells(number_of_cells(), Vec3f::Zero()), averages(cells.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    each_corner(places_[i], [&](std::size_t cell, float weight) {
      cells[cell] += weight * Vec3f(values[i].x(), values[i].y(), 1);
    });
  average_across(1, cells, averages);
  average_across(width_, averages, cells);
  average_along(cells, averages);
  parallel_for(values.size(), [&](std::size_t i) {
    Vec3f sum = Vec3f::Zero();
    each_corner(places_[i], [&](std::size_t cell, float weight) { sum += weight * averages[cell]; });
    values[i] = sum.head<2>() / sum.z();
  });
}

std::vector<float> blurred(std::span<const Vec3> points, std::span<const float> values, double sigma) {
  std::vector<Vec2f> pairs;
  for (const float value : values) pairs.emplace_back(value, 0);
  SurfaceBlur(points, sigma).apply(pairs);
  std::vector<float> averages;
  for (const Vec2f& pair : pairs) averages.push_back(pair.x());
  return averages;
}

}  // namespace relievo
