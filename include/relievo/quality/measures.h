// Objective measures of how much of its model a relief shows, and of the relief's faults. docs/quality.md
// defines each measure and gives its source.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "relievo/scan/surface.h"

namespace relievo {

// The measures are taken on a picture whose longer side is 512 pixels, inside the silhouette and at least 5
// pixels away from it and from the model's depth jumps; halo, steep_share, height_used and the steps use all
// pixels. The model is given by the scan's own normals and depths. Fray, facets and sides are measured on the
// surface's triangles. A noisy relief can win on shading, so read the measures together.
struct Measures {
  double shading = 0;    // mean SSIM of Lambert shadings under 16 lights, [-1, 1]; 1 equals the model
  double angle_deg = 0;  // mean angle between the relief's and the model's normals
  std::array<double, 3>
      detail{};           // correlation of div n, smoothed by Gaussians of 1, 2 and 4 pixels, [-1, 1]
  double order = 0;       // share of random pairs, over 1 % apart in depth, whose depth order is kept
  double near_order = 0;  // the same for pairs that are 3 to 10 % of the longer side apart

  double halo = 0;                 // standard deviation of heights in the background, as a share of `height`
  double steep_share = 0;          // share of the silhouette's pixels that are steeper than 80 degrees
  double height_used = 0;          // height from the 1st to the 99th percentile, as a share of `height`
  double jump_step = 0;            // greatest step left at a depth jump of the model, as a share of `height`
  double rim_step = 0;             // greatest height one edge inside the silhouette, as a share of `height`
  double silhouette_fray_deg = 0;  // scatter of the tilt beside the silhouette around its smoothed values
  double jump_fray_deg = 0;        // the same scatter beside depth jumps, on both sides
  double facet_angle_deg = 0;      // 99th percentile of angles between triangles where the model is smooth
  double longest_side = 0;         // longest side of a triangle, in sampling distances
  double height = 0;               // lowest to highest, base included, in the surface's units
};

// Measures reliefs against their model. Const calls may run concurrently.
class ReliefMetrics {
 public:
  static constexpr int longer_side_px = 512;
  static constexpr int margin_px = 8;  // width of the background around the model

  // Keeps a reference to the surface, which must outlive this object. No pixels are measured if the surface
  // has no area.
  explicit ReliefMetrics(const Surface& surface);
  ReliefMetrics(ReliefMetrics&&) noexcept;
  ~ReliefMetrics();

  // Measures heights above the base, one per point of the surface. All measures are 0 if no pixel is far
  // enough from silhouette and jumps; correlations with a constant are 0.
  Measures measure(std::span<const double> heights) const;

  // Returns Measures::shading alone, in a fraction of the time, also of level heights.
  double shading(std::span<const double> heights) const;

  // Returns the number of pixels that are measured.
  std::size_t pixels() const;

 private:
  struct Reference;
  std::unique_ptr<Reference> reference_;
};

}  // namespace relievo
