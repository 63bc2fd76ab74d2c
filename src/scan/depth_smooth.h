// Smoothing of heights on a grid between two bounds at each place. Tested by tests/scan/depth_image_test.cpp.
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

// Returns the smoothest heights with low <= z <= high at all known places, 0 at unknown ones: the sum of
// their squared second differences (along rows, along columns, and twice the mixed one), over joined places, is
// nearly minimal. Solves from coarse to fine grids in linear time: 2 s for a million places on two cores.
std::vector<float> smoothest(const BoundedGrid& grid);

}  // namespace relievo
