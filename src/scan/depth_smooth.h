// The smoothest heights of a grid between two bounds at each place.
#pragma once

#include <cstdint>
#include <vector>

namespace relievo {

// Row-major. Bounds count only where `is_known`; connections only between two known places.
struct BoundedGrid {
  int width = 0, height = 0;
  std::vector<float> low, high;
  std::vector<std::uint8_t> is_known;
  std::vector<std::uint8_t> joins_right, joins_down;  // no depth jump between this place and that neighbour

  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  }
};

// Returns heights with low <= z <= high at the known places that bend as little as possible: the sum of the
// squared second differences along rows, columns and diagonals, over places that are joined, is near its
// least. 0 at unknown places. Coarse to fine; time linear in the places, 2 s for a million on two cores.
std::vector<float> smoothest(const BoundedGrid& grid);

}  // namespace relievo
