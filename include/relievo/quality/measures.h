// Measures how much of the model a relief shows, and the faults of the relief. docs/quality.md defines each
// measure and gives its source.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "relievo/scan/surface.h"

namespace relievo {

// The measures are taken on a picture whose longer side has 512 pixels. They use the pixels inside the
// silhouette that are at least 5 pixels away from it and from the model's depth jumps. But halo, steep_share,
// height_used, jump_step and rim_step use all pixels. The model is represented by the scan's own normals and
// depths. silhouette_fray_deg, jump_fray_deg, facet_angle_deg and longest_side are measured on the surface's
// triangles. A noisy relief can have a better shading than a smooth one, so the measures should be read
// together.
struct Measures {
  double shading = 0;    // mean SSIM of Lambert shadings under 16 lights, [-1, 1]; 1 equals the model
  double angle_deg = 0;  // mean angle between the relief's and the model's normals
  std::array<double, 3> detail{};  // correlation of div n after Gaussian blurs of 1, 2 and 4 pixels, [-1, 1]
  double order = 0;  // share of random pairs, with depths more than 1 % apart, that keep their depth order
  double near_order = 0;  // the same share for pairs at a distance of 3 to 10 % of the longer side

  double halo = 0;                 // standard deviation of heights in the background, as a share of `height`
  double steep_share = 0;          // share of the silhouette's pixels steeper than 80 degrees
  double height_used = 0;          // 99th minus 1st percentile of the heights, as a share of `height`
  double jump_step = 0;            // largest step at a depth jump of the model, as a share of `height`
  double rim_step = 0;             // largest height of points next to the silhouette, as a share of `height`
  double silhouette_fray_deg = 0;  // scatter of the triangles' tilt along the silhouette, see docs/quality.md
  double jump_fray_deg = 0;        // the same scatter along both sides of depth jumps
  double facet_angle_deg = 0;  // 99th percentile of the angles between triangles where the model is smooth
  double longest_side = 0;     // longest triangle side, in sampling distances
  double height = 0;           // highest minus lowest height, base included, in the surface's units
};

// Measures reliefs of one surface against their model. Const calls may run concurrently.
class ReliefMetrics {
 public:
  static constexpr int longer_side_px = 512;
  static constexpr int margin_px = 8;  // width of the background around the model, in pixels

  // Keeps a reference to the surface, which must outlive this object. If the surface has no area, no pixels
  // are measured.
  explicit ReliefMetrics(const Surface& surface);
  ReliefMetrics(ReliefMetrics&&) noexcept;
  ~ReliefMetrics();

  // Returns the measures of heights above the base, one per point of the surface. All measures are 0 if no
  // pixel is far enough from silhouette and jumps; correlations with a constant are 0.
  Measures measure(std::span<const double> heights) const;

  // Returns only Measures::shading, in a fraction of the time. The heights may all be equal.
  double shading(std::span<const double> heights) const;

  // Returns the number of measured pixels.
  std::size_t pixels() const;

 private:
  struct Reference;
  std::unique_ptr<Reference> reference_;
};

}  // namespace relievo
