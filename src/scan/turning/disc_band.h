// A band of rows of FrontCells, into which points are drawn as discs. Tested by tests/scan/turning_test.cpp.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "relievo/core/types.h"
#include "scan/scan_limits.h"
#include "scan/turning/front_cells.h"

namespace relievo {

// A point as a disc in view coordinates, in units of cells from the grid's corner.
struct FrontDisc {
  // Radius of the discs that hide what is behind them, in spacings.
  static constexpr float hiding_radius{ScanLimits::disc_radius};

  Vec3f place;
  Vec3f normal;
  Vec2f slope;
  float spacing;
};

// Rows of one band, with room behind each row for the last vector of cells that a disc covers.
class DiscBand {
 public:
  DiscBand(int columns, int first_row, int rows);

  // Raises depths to those of discs. All depths must be drawn before the first normal.
  void draw_depths(std::span<const FrontDisc> discs);

  // Adds the normal of each disc to the cells around it in which the disc is in front.
  void add_normals(std::span<const FrontDisc> discs);

  // Writes depths and unit normals to the band's rows.
  void write(FrontCells& cells) const;

  // Returns the first cell of a row, which is counted from the band's first row.
  float* depths(int row) { return depth_.data() + row * stride_; }
  float* normals(int axis, int row) { return normal_[static_cast<std::size_t>(axis)].data() + row * stride_; }
  int columns() const { return columns_; }
  int first_row() const { return first_row_; }
  int rows() const { return rows_; }

 private:
  int columns_, first_row_, rows_, stride_;
  std::vector<float> depth_;
  std::array<std::vector<float>, 3> normal_;  // x, y and z
};

}  // namespace relievo
