// A depth image as heights over its pixels, before they become points.
#pragma once

#include "relievo/depth_image.h"
#include "scan/depth_smooth.h"

namespace relievo {

// Heights towards the viewer, in pixels of the (reduced) grid, each with what it may be off.
struct DepthGrid {
  BoundedGrid bounds;         // their middle is the height
  std::vector<float> height;  // of known places
  int reduction = 1;
  double noise = 0;
  std::size_t missing = 0;
  bool is_sensor = false;  // values come in coarser steps than the file's, as those of depth cameras do
};

// Returns the grid, reduced to about the wanted number of points, with bounds that hold the step of the
// values and the noise, and with no place joined yet.
DepthGrid make_grid(const DepthImage& image, const DepthOptions& options);

// Joins neighbours between which there is no jump in depth.
void join(DepthGrid& grid);

// Forgets places on ramps that a blurred outline leaves between two surfaces; returns how many.
std::size_t cut_ramps(DepthGrid& grid);

// Forgets what lies behind the largest gap in depth, if that is most of the border and not nearly all or
// nothing of the picture; returns how many places.
std::size_t remove_background(DepthGrid& grid);

}  // namespace relievo
