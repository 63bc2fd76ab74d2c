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

// The points of a surface under a stroke, and how much of its change each gets.
struct StrokeMask {
  std::vector<Index> points;
  std::vector<float> weights;  // (0, 1], one per point
};

// Returns the mask of a stroke. A point at distance d from the line gets (1 - x^2)^2, where x goes from 0 to 1 over the
// outer part `softness` of the radius; beside the base that fades as w_b of (7) does. Only points count that are
// connected to the line without a depth jump between. The mask is empty where the view shows nothing of the line.
StrokeMask stroke_mask(const Surface& surface, const Stroke& stroke);

// The strokes of a relief on one surface, which must outlive them. `Real` is the type of the heights.
template <typename Real>
class StrokeFields {
 public:
  explicit StrokeFields(const Surface& surface) : surface_(&surface) {}

  // Takes these strokes in place of the former ones. Masks of strokes that did not change are kept.
  void take(const Strokes& strokes);

  bool empty() const { return changed_.empty(); }

  // Changes the heights z of a relief of that height, in the surface's units. Heights outside of the strokes keep their
  // values. No height falls below the base, 0. The highest point may change: the caller restores the height.
  void apply(double height, std::span<Real> z);

 private:
  // A blur of the heights at some points. The heights around them stay as they are.
  struct Blur {
    struct Link {
      Index a, b;
      float pull;
    };
    std::vector<Index> points;
    std::vector<float> areas;    // of the points, as shares of the mean
    std::vector<float> amounts;  // by which what the blur removes is added, one per point
    std::vector<Link> links;
    std::optional<solver::Cholesky> system;
    std::optional<solver::Cholesky::Workspace> workspace;
  };

  void take_masks(const Strokes& strokes);
  void take_raised();
  Blur blur_of(double sigma, std::span<const float> amounts) const;
  void add_removed(Blur& blur, std::span<const Real> z);

  const Surface* surface_;
  Strokes strokes_;                // those of masks_
  std::vector<StrokeMask> masks_;  // empty for muted strokes
  std::vector<Index> changed_;     // the points under at least one stroke
  std::vector<float> raised_;      // share of the relief's height that strokes add, per point of the surface
  std::vector<Blur> blurs_;        // those with at least one stroke
  std::vector<std::size_t> levels_;  // numbers of the strokes that level
  // Scratch memory: what all blurs add, the right-hand side of a system, and its solution.
  std::vector<Real> added_, pulled_, moved_;
};

// Applies the strokes of the relief's shape to its heights. The relief keeps its height.
void apply_strokes(const Surface& surface, Relief& relief);

}  // namespace relievo
