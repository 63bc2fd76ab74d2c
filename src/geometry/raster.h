// Orthographic scan conversion on the CPU: finds the triangle that is seen at the centre of each pixel, and
// its height there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "relievo/core/image.h"
#include "relievo/core/parallel.h"
#include "relievo/core/types.h"

namespace relievo {

// The triangles to be drawn. Points are in pixels: x to the right, y down; z grows towards the viewer. Points
// may lie outside [0, width] x [0, height], by at most 2^17 pixels. The centre of the first pixel is at (0.5,
// 0.5).
struct RasterInput {
  static constexpr int most_pixels = 32768;  // limit of width and height: keeps the coverage test exact

  std::vector<Vec3> points;
  std::span<const Triangle> triangles;  // counter-clockwise as seen; the others face away and are skipped
  int width = 0, height = 0;
};

// The triangle that is seen at a pixel's centre.
struct Fragment {
  float z = -std::numeric_limits<float>::infinity();
  Index triangle = no_index;  // no_index: nothing
};

// A band of full rows of the picture.
struct RowBand {
  int first_row = 0;
  Image<Fragment> fragments;
};

// Triangles sorted into bands of rows, which can be drawn in any order and concurrently. The coverage test is
// exact on corners rounded to 1/256 pixel: every centre inside a surface belongs to exactly one of its
// triangles, also on shared edges. Of equally near triangles the first is seen. The scene must outlive the
// object.
class Rasterizer {
 public:
  Rasterizer(const RasterInput& scene, int band_rows);

  std::size_t bands() const { return first_.size() - 1; }
  RowBand draw(std::size_t band) const;

 private:
  struct Corner {
    int x, y;  // in 1/256 pixel
  };
  // The first column whose centre is not left of a corner, and the first row whose centre is not above it.
  // Without such a column or row, the picture's width or height.
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
  std::vector<std::size_t> first_;  // per band and one more: where its triangles begin
  std::vector<Index> triangles_;    // by band, in the scene's order
};

// Draws a scene in bands of that many rows, and calls use(band) for each, concurrently.
template <typename F>
void draw_bands(const RasterInput& scene, int band_rows, F&& use) {
  const Rasterizer rasterizer(scene, band_rows);
  parallel_for(
      rasterizer.bands(), [&](std::size_t b) { use(rasterizer.draw(b)); }, 1);
}

// Returns the weights of the triangle's corners at a place in the picture. The weights are not negative, even
// for places outside the triangle.
Vec3f corner_weights(const RasterInput& scene, Index triangle, double x, double y);

}  // namespace relievo
