// The squares by which a surface is sampled. Tested by tests/plate/sample_squares_test.cpp.
#pragma once

#include <vector>

#include "relievo/core/image.h"
#include "relievo/core/types.h"

namespace relievo {

struct SampleSquare {
  int x = 0, y = 0;           // its upper left cell
  int side = 1;               // 1, 2, 4 or 8 cells
  bool is_quartered = false;  // one cell, which takes four samples
};

// Cells on a side of the largest square; width and height of the grid are multiples of it.
constexpr int largest_square = 8;

// Returns squares that cover the cells of a grid that have a slope, not NaN. Across a square of several cells the surface
// turns by no more than `facet_angle`, in radians, about; a cell is quartered where the surface turns evenly by more.
// Next to a square lie none of less than half its side, quarters aside.
std::vector<SampleSquare> sample_squares(const Image<Vec2f>& slopes, float facet_angle);

}  // namespace relievo
