// Applies strokes to the heights of a relief. Tested by tests/relief/stroke_fields_test.cpp.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "relievo/relief/relief.h"
#include "relievo/relief/stroke.h"
#include "relievo/scan/surface.h"
#include "relievo/solver/cholesky.h"

namespace relievo {

// The points of a surface under a stroke, and the share of the stroke's change that each point gets.
struct StrokeMask {
  std::vector<Index> points;
  std::vector<float> weights;  // (0, 1], one per point
};

// Returns the mask of a stroke. At distance d from the line the weight is (1 - x^2)^2, where x rises from 0
// to 1 over the outer part `softness` of the radius. Near the boundary the weight fades like w_b of (7). The
// mask has only points that are connected to the line without crossing a depth jump. It is empty if no point
// of the line is on the visible surface.
StrokeMask stroke_mask(const Surface& surface, const Stroke& stroke);

// The strokes of a relief on one surface, which must outlive this object. `Real` is the type of the heights.
template <typename Real>
class StrokeFields {
 public:
  explicit StrokeFields(const Surface& surface) : surface_(&surface) {}

  // Replaces the strokes. Strokes that were there before keep their masks.
  void take(const Strokes& strokes);

  bool empty() const { return changed_.empty(); }

  // Changes the heights z of a relief of the given height, in the surface's units. Heights outside of the
  // strokes keep their values. No height falls below the base, 0. The highest point may change; the caller
  // then restores the height.
  void apply(double height, std::span<Real> z);

 private:
  // A blur of the heights at some points. The heights around them stay as they are.
  struct Blur {
    struct Link {
      Index a, b;
      float pull;
    };
    std::vector<Index> points;
    std::vector<float> areas;    // areas of the points, as shares of their mean area
    std::vector<float> amounts;  // per point: factor of the difference between height and blurred height
    std::vector<Link> links;
    std::optional<solver::Cholesky> system;
    std::optional<solver::Cholesky::Workspace> workspace;
  };

  void take_masks(const Strokes& strokes);
  void take_raised();
  Blur blur_of(double sigma, std::span<const float> amounts) const;
  void add_removed(Blur& blur, std::span<const Real> z);

  const Surface* surface_;
  Strokes strokes_;                // the strokes of masks_
  std::vector<StrokeMask> masks_;  // empty for muted strokes
  std::vector<Index> changed_;     // the points under at least one stroke
  std::vector<float> raised_;      // share of the relief's height that strokes add, per point of the surface
  std::vector<Blur> blurs_;        // at most two: narrow and wide
  std::vector<std::size_t> levels_;  // numbers of the strokes with Brush::level
  // Scratch memory: the sum of all blurs' changes, the right-hand side of a system, and its solution.
  std::vector<Real> added_, pulled_, moved_;
};

// Applies the strokes of the relief's shape to its heights, and restores the height of the relief.
void apply_strokes(const Surface& surface, Relief& relief);

}  // namespace relievo
