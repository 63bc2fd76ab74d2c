// Blurs values along a surface by a Gaussian. It averages points that are close in space. So points beyond a depth
// jump do not count, although they are close in the view plane.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// A Gaussian blur of one width, prepared for given points. The points' values are distributed to a grid of
// cells about as wide as the Gaussian, averaged with neighbouring cells, and interpolated back. Only cells
// around the points are stored: in each column along z, the cells from the lowest to the highest point near
// the column.
class SurfaceBlur {
 public:
  // `sigma` > 0 is the standard deviation. It is increased if the grid would have more than 2^24 cells.
  SurfaceBlur(std::span<const Vec3> points, double sigma);

  // Replaces each value, one per point, by the average around its point.
  void apply(std::span<Vec2f> values) const;

  std::size_t number_of_cells() const { return columns_.back().first; }

 private:
  // The cells with the same x and y, and z in [low, high). The cells of the next column follow in memory.
  struct Column {
    std::size_t first = 0;  // index of the cell at `low`
    int low = 0, high = 0;

    bool is_empty() const { return low == high; }
    std::size_t size() const { return static_cast<std::size_t>(high - low); }
    std::size_t cell(int z) const { return first + static_cast<std::size_t>(z - low); }
    void extend(int from, int to) {
      low = is_empty() ? from : std::min(low, from);
      high = std::max(high, to);
    }
  };
  // The cell with the smallest coordinates among the eight cells around a point. `share` is the point's
  // position between that cell and the others.
  struct Place {
    Index column = 0;
    int z = 0;
    Vec3f share = Vec3f::Zero();
  };
  using Cells = std::vector<Vec3f>;

  std::vector<Column> columns_around_points(std::size_t count) const;
  template <typename F>
  void each_corner(const Place& place, F&& f) const;
  void average_across(std::size_t step, const Cells& cells, Cells& averages) const;
  void average_along(const Cells& cells, Cells& averages) const;

  std::size_t width_ = 0;  // columns per row
  std::vector<Place> places_;
  std::vector<Column> columns_;  // followed by an empty column that begins after the last cell
};

// Returns one blurred value per point. `sigma` > 0 is the standard deviation of the Gaussian.
std::vector<float> blurred(std::span<const Vec3> points, std::span<const float> values, double sigma);

}  // namespace relievo
