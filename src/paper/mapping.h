// The mapping of heights from the control points to all visible points (section 3.5).
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "relievo/geometry/spline.h"

namespace relievo::paper {

// Heights below this share of the largest have no definite ratio.
inline constexpr float faint_share = .02F;

// Returns the compression ratio z / z0, which goes to 0 where z0 is below `faint`.
inline float compression_ratio(float z, float z0, float faint) {
  return z * z0 / std::max(z0 * z0 + faint * faint, 1e-30F);
}

// Carries the compression ratio of the control points, their height divided by the one without compression, to
// all visible points by a multilevel B-spline, and multiplies it there by the heights without compression.
class HeightMapping {
 public:
  // Scratch memory of carry(), so that it allocates nothing.
  struct Workspace {
    std::vector<float> ratio;  // of the control points
    SplineFunction function;
    MultilevelSpline::Workspace fit;
  };

  // The heights that (9) gives with w_k = 1, at the control points and at all visible points. The depth jumps of
  // the model are gone from them ("prediscontinuous removal" in Fig. 6).
  struct Uncompressed {
    std::vector<float> control, visible;
  };

  HeightMapping(std::span<const Vec2> control, std::span<const Vec2> visible, Uncompressed uncompressed);

  std::size_t size() const { return uncompressed_.visible.size(); }
  std::size_t memory() const;
  Workspace make_workspace() const;

  // Writes the heights of all visible points for those of the control points.
  void carry(std::span<const float> control_heights, Workspace& workspace, std::span<float> heights) const;

 private:
  Uncompressed uncompressed_;
  float faint_;  // see compression_ratio()
  MultilevelSpline spline_;
  std::vector<SplinePlace> places_;
};

}  // namespace relievo::paper
