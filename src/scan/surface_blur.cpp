#include "scan/surface_blur.h"

#include <algorithm>
#include <cmath>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// A few points would spend all their time on empty cells.
constexpr double most_cells = 1 << 24, least_cells = 1 << 16, most_cells_a_point = 1 << 12;
// The standard deviation of the blur, in cells. Its three steps add up their variances: distributing to cells
// and interpolating back, both linear, have 1/6 each, averaging neighbours with weights 1, 2, 1 has 1/2.
const double sigma_in_cells = std::sqrt(5.0 / 6);

// Calls f(cell, weight) for the eight cells around a place.
template <typename F>
void each_corner(Index cell, const Vec3f& share, const std::array<std::size_t, 3>& size, F&& f) {
  for (int corner = 0; corner < 8; ++corner) {
    const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
    const float weight =
        (x ? share.x() : 1 - share.x()) * (y ? share.y() : 1 - share.y()) * (z ? share.z() : 1 - share.z());
    f(cell + static_cast<std::size_t>(x) +
          size[0] * (static_cast<std::size_t>(y) + size[1] * static_cast<std::size_t>(z)),
      weight);
  }
}

// Lines of cells side by side, from the first cell of the first line.
struct Lines {
  Vec3f* first;
  std::size_t step, size;  // of each line: from cell to cell, and the number of cells
};

// Replaces each cell of so many lines by the sum of itself, twice, and its neighbours in the line.
void average_lines(const Lines& lines, std::size_t count) {
  std::vector<Vec3f> before(count, Vec3f::Zero());  // the cells before these, as they were
  for (std::size_t along = 0; along < lines.size; ++along) {
    Vec3f* const cells = lines.first + along * lines.step;
    for (std::size_t j = 0; j < count; ++j) {
      Vec3f sum = 2 * cells[j];
      if (along > 0) sum += before[j];
      if (along + 1 < lines.size) sum += cells[j + lines.step];
      before[j] = cells[j];
      cells[j] = sum;
    }
  }
}

}  // namespace

SurfaceBlur::SurfaceBlur(std::span<const Vec3> points, double sigma) : places_(points.size()) {
  const Box box = Box::of(points);
  double side = sigma / sigma_in_cells;
  // Numbers may be beyond those of a size, which has 32 bits in WebAssembly.
  const auto count = [&](int axis) { return std::floor(box.size()[axis] / side) + 4; };
  const double most =
      std::clamp(most_cells_a_point * static_cast<double>(points.size()), least_cells, most_cells);
  while (count(0) * count(1) * count(2) > most) side *= 1.1;
  for (int axis = 0; axis < 3; ++axis)
    size_[static_cast<std::size_t>(axis)] = static_cast<std::size_t>(count(axis));
  parallel_for(points.size(), [&](std::size_t i) {
    const Vec3 at = (points[i] - box.min) / side + Vec3::Ones();  // a cell of margin for the neighbours
    const Vec3 floor = at.array().floor();
    places_[i].cell = static_cast<Index>(
        static_cast<std::size_t>(floor.x()) +
        size_[0] * (static_cast<std::size_t>(floor.y()) + size_[1] * static_cast<std::size_t>(floor.z())));
    places_[i].share = (at - floor).cast<float>();
  });
}

void SurfaceBlur::average_cells(std::vector<Vec3f>& cells) const {
  std::size_t step = 1;
  for (const std::size_t size : size_) {
    // Neighbouring lines are averaged together, as their cells are neighbours in memory, and in place, as the grid may
    // be most of the memory that a relief takes.
    const std::size_t most_lines = 256, bundles = (step + most_lines - 1) / most_lines;
    parallel_for(cells.size() / (step * size) * bundles, [&](std::size_t i) {
      const std::size_t first = i % bundles * most_lines;
      average_lines({&cells[i / bundles * step * size + first], step, size},
                    std::min(most_lines, step - first));
    });
    step *= size;
  }
}

void SurfaceBlur::apply(std::span<Vec2f> values) const {
  std::vector<Vec3f> cells(number_of_cells(), Vec3f::Zero());
  for (std::size_t i = 0; i < values.size(); ++i)
    each_corner(places_[i].cell, places_[i].share, size_, [&](std::size_t cell, float weight) {
      cells[cell] += weight * Vec3f(values[i].x(), values[i].y(), 1);
    });
  average_cells(cells);
  parallel_for(values.size(), [&](std::size_t i) {
    Vec3f sum = Vec3f::Zero();
    each_corner(places_[i].cell, places_[i].share, size_,
                [&](std::size_t cell, float weight) { sum += weight * cells[cell]; });
    values[i] = sum.head<2>() / sum.z();
  });
}

}  // namespace relievo
