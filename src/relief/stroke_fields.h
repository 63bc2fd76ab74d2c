// Applies strokes to the heights of a relief.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "relief/stroke_blur.h"
#include "relief/stroke_moves.h"
#include "relievo/relief/relief.h"
#include "relievo/relief/stroke.h"
#include "relievo/scan/surface.h"

namespace relievo {

// Returns the mask of a stroke: points_of() with weights. At distance d the weight is (1 - x^2)^2, where x rises from 0
// to 1 over the outer part `softness` of the radius. Near the boundary the weight fades like w_b of equation (7). The
// mask is empty if the visible surface has no point of the stroke.
StrokeMask stroke_mask(const Surface& surface, const Stroke& stroke);

// The strokes of a relief on one surface. The surface must outlive this object. `Real` is the type of the heights.
template <typename Real>
class StrokeFields {
 public:
  explicit StrokeFields(const Surface& surface) : surface_(&surface) {}

  // Replaces the strokes. Strokes that did not change keep their masks and systems, so that while one stroke is being
  // drawn only that stroke costs time.
  void take(const Strokes& strokes);

  bool empty() const { return changed_.empty(); }

  // Changes the heights z of a relief of the given height, in the surface's units. `uncorrected` has the heights
  // before the height correction, for Brush::protect; if it is empty, that brush changes nothing. Heights outside of
  // the strokes keep their values. No height falls below the base, 0. The highest point may change; the caller then
  // restores the height.
  void apply(double height, std::span<const Real> uncorrected, std::span<Real> z);

 private:
  // A factor for one point: this share of the detail that the stroke's blur removes is added to the point's height.
  struct Share {
    Index at;  // index in changed_
    Real share;
  };
  struct Layer {
    Stroke stroke;
    StrokeMask mask;                       // empty for muted strokes
    std::optional<StrokeBlur<Real>> blur;  // only if the brush needs it
    std::vector<Crossing> crossings;       // only for Brush::in_front
    std::vector<Share> shares;             // one per point of the mask, if the brush needs a blur
  };

  Layer layer_of(const Stroke& stroke);
  void take_layers(const Strokes& strokes);
  void take_blurs(std::span<const Real> z);
  void sum_masks();
  void add_sums(double height, std::span<Real> z);
  template <typename F>
  void each_of(Brush brush, F&& f) const;

  const Surface* surface_;
  std::optional<SurfaceLinks> links_;  // computed when a blur first needs them
  std::vector<Layer> layers_;          // one per stroke
  std::vector<Index> changed_;         // the points under at least one stroke
  std::vector<Real> blurred_;          // the heights that blurs were last computed for
  // One value per point of changed_. risen_ is the height by which strokes raise the point, as a share of
  // the relief's height; added_ is scratch memory.
  std::vector<Real> risen_, added_;
};

// Returns whether apply() needs the uncorrected heights for these strokes.
bool needs_uncorrected(const SharedStrokes& strokes);

// Applies the strokes of the relief's shape to its heights, and restores the height of the relief. `uncorrected` is the
// same as for StrokeFields::apply().
void apply_strokes(const Surface& surface, std::span<const double> uncorrected, Relief& relief);

}  // namespace relievo
