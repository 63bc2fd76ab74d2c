// Maps heights from the control points to all visible points (section 3.5).
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "relievo/geometry/spline.h"

namespace relievo::paper {

// The ratio z / z0 is unreliable where z0, the height without compression, is below this share of the largest z0.
inline constexpr float faint_share = .02F;

// Returns the compression ratio z / z0 times z0^2 / (z0^2 + faint^2), which is 1/2 at z0 = `faint`.
inline float compression_ratio(float z, float z0, float faint) {
  return z * z0 / std::max(z0 * z0 + faint * faint, 1e-30F);
}

// Carries heights from the control points to all visible points by their compression ratio: the height
// divided by the height without compression. A multilevel B-spline interpolates the ratio of the control
// points at all visible points. Then each visible point's ratio is multiplied by the point's height without
// compression.
class HeightMapping {
 public:
  // Scratch memory, so that carry() allocates nothing.
  struct Workspace {
    std::vector<float> ratio;  // compression ratio of the control points
    SplineFunction function;
    MultilevelSpline::Workspace fit;
  };

  // Heights without compression, from (9) with w_k = 1, at the control points and at all visible points. Whatever the
  // relief's coefficients are, w_b and the slope limit have their default values. The heights do not contain the
  // model's depth jumps ("prediscontinuous removal" in Fig. 6).
  struct Uncompressed {
    std::vector<float> control, visible;
  };

  HeightMapping(std::span<const Vec2> control, std::span<const Vec2> visible, Uncompressed uncompressed);

  std::size_t size() const { return uncompressed_.visible.size(); }
  std::size_t memory() const;
  Workspace make_workspace() const;

  // Writes the heights of all visible points, given those of the control points.
  void carry(std::span<const float> control_heights, Workspace& workspace, std::span<float> heights) const;

 private:
  Uncompressed uncompressed_;
  float faint_;  // see compression_ratio()
  MultilevelSpline spline_;
  std::vector<SplinePlace> places_;
};

}  // namespace relievo::paper
