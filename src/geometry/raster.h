// Rasterises triangles orthographically on the CPU: finds the visible triangle at the centre of each pixel, and its
// height there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "relievo/core/image.h"
#include "relievo/core/parallel.h"
#include "relievo/core/types.h"

namespace relievo {

// The triangles to be drawn. Points are in pixels: x to the right, y down; z grows towards the viewer. Points
// may lie outside [0, width] x [0, height], by at most 2^17 pixels. The centre of the first pixel is at
// (0.5, 0.5).
struct RasterInput {
  static constexpr int most_pixels = 32768;  // limit of width and height, which keeps the coverage test exact

  std::vector<Vec3> points;
  // Triangles that the viewer sees counter-clockwise are drawn. The others face away from the viewer.
  std::span<const Triangle> triangles;
  int width = 0, height = 0;
};

// The visible triangle at a pixel's centre.
struct Fragment {
  float z = -std::numeric_limits<float>::infinity();
  Index triangle = no_index;  // no_index if there is none
};

// A range of full rows of the image.
struct RowBand {
  int first_row = 0;
  Image<Fragment> fragments;
};

// Sorts triangles into bands of rows, which can be drawn in any order and concurrently. Corners are rounded to 1/256
// pixel. For the rounded corners the coverage test is exact: every pixel centre inside a surface belongs to exactly
// one of its triangles, also on shared edges. Of triangles at the same height the first is visible. The scene must
// outlive the object.
class Rasterizer {
 public:
  Rasterizer(const RasterInput& scene, int band_rows);

  std::size_t bands() const { return first_.size() - 1; }
  RowBand draw(std::size_t band) const;

 private:
  struct Corner {
    int x, y;  // in 1/256 pixel
  };
  // The first column whose centre is not left of a corner, and the first row whose centre is not above it. If
  // all columns are left of the corner, `column` is the image's width. If all rows are above it, `row` is the
  // height.
  struct Cell {
    std::uint16_t column, row;
  };
  struct Rows {
    int begin, end;
  };
  struct InBands {
    Index triangle;
    Rows bands;
  };
  bool slips_through(const Triangle& triangle) const;
  bool is_facing(const Triangle& triangle) const;
  Rows rows_of(const Triangle& triangle) const;
  std::vector<InBands> covering(std::size_t begin, std::size_t end) const;
  void sort_into_bands();
  void draw_triangle(Index t, Rows rows, RowBand& band) const;

  const RasterInput& scene_;
  int band_rows_;
  std::vector<Corner> corners_;     // per point
  std::vector<Cell> cells_;         // per point
  std::vector<std::size_t> first_;  // per band: where its triangles begin in triangles_; then their end
  std::vector<Index> triangles_;    // triangles of each band, in the order of the scene
};

// Draws a scene in bands of `band_rows` rows. Calls use(band) for each band, concurrently.
template <typename F>
void draw_bands(const RasterInput& scene, int band_rows, F&& use) {
  const Rasterizer rasterizer(scene, band_rows);
  parallel_for(
      rasterizer.bands(), [&](std::size_t b) { use(rasterizer.draw(b)); }, 1);
}

// Returns the barycentric weights of the triangle's corners at a position in the image. Weights are not
// negative, even for positions outside the triangle.
Vec3f corner_weights(const RasterInput& scene, Index triangle, double x, double y);

}  // namespace relievo
