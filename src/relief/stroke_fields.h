// Applies strokes to the heights of a relief.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/groups.h"
#include "relievo/relief/relief.h"
#include "relievo/relief/stroke.h"
#include "relievo/scan/surface.h"
#include "relievo/solver/cholesky.h"

namespace relievo {

// The edges and areas of a surface, from which blurs are built.
struct SurfaceLinks {
  struct Link {
    Index to;
    float weight;  // the result of edge_weight()
  };
  Groups<Link> links;        // per point: its edges inside the relief that are no depth jumps
  std::vector<float> areas;  // per point: a third of the area of its triangles, in the view plane
};

// Returns the links and areas of all points of the surface.
SurfaceLinks surface_links(const Surface& surface);

// Computes the difference between heights and their blur at some points. The heights of all other points stay fixed.
// The blur does not cross depth jumps. `Real` is the type of the heights.
template <typename Real>
class StrokeBlur {
 public:
  // `sigma` is the standard deviation of the blur, in the units of the surface.
  StrokeBlur(const Surface& surface, const SurfaceLinks& links, std::span<const Index> points, double sigma);

  // Computes removed() for the heights z of all points of the surface.
  void take(std::span<const Real> z);

  // Returns the height minus the blurred height, one per point; empty before the first take().
  const std::vector<Real>& removed() const { return removed_; }

 private:
  // A link from a point to a point of points_. `to` is an index in points_. If `from` is less than the size
  // of points_, it is also an index in points_. Otherwise `from` minus this size is an index in around_.
  struct Link {
    Index to, from;
    Real pull;
  };

  std::vector<Index> points_, around_;
  std::vector<Link> links_;
  std::vector<Real> areas_;
  std::optional<solver::Cholesky> system_;
  std::optional<solver::Cholesky::Workspace> workspace_;
  std::vector<Real> removed_;
};

// The points of a surface under a stroke, and the share of the stroke's change that each point gets.
struct StrokeMask {
  std::vector<Index> points;
  std::vector<float> weights;  // (0, 1], one per point
};

// The heights of a relief whose height is `height`, before and after the height correction.
template <typename Real>
struct CorrectedHeights {
  const Surface& surface;
  double height;
  std::span<const Real> uncorrected;
  std::span<Real> z;
};

// Moves the heights under a stroke towards the uncorrected heights plus the plane that fits the height correction best.
// Each height moves by its weight times `amount`. If the result would exceed the height of the relief anywhere, the
// plane is lowered. The mask must not be empty. Instantiated for float and double.
template <typename Real>
void protect(const CorrectedHeights<Real>& heights, const StrokeMask& mask, double amount);

// An edge that leads from a point of a mask across a depth jump.
struct Crossing {
  Index from;    // index in the points of the mask
  Index behind;  // index of the surface point at the deeper end
};

// Returns edges across depth jumps. Each begins at a point of the mask with a weight of at least 1/2, and
// ends at a deeper point outside of the mask.
std::vector<Crossing> crossings_of(const Surface& surface, const StrokeMask& mask);

// The rise that a stroke should have above the surface behind it.
template <typename Real>
struct InFront {
  std::span<const Crossing> crossings;
  Real step;    // least rise of each crossing
  Real height;  // the height of the relief
};

// Raises the heights z under a stroke by their weights times r (1 - z / height). So nothing exceeds the
// height, and higher points stay higher. r is the least value with which each crossing rises by at least
// InFront::step. But r is at most the height, so crossings near the top may rise less. Instantiated for float
// and double.
template <typename Real>
void bring_forward(const InFront<Real>& wanted, const StrokeMask& mask, std::span<Real> z);

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

// The points of an area. Each has a distance from the part of the area that is changed fully; the distance is
// in [0, the stroke's radius).
struct StrokePoints {
  std::vector<Index> points;
  std::vector<double> distances;
};

// Returns the points of a stroke, without those on the boundary; none if the view does not show the stroke.
//
// A line consists of points whose distance from it, in space, is less than the radius. They must connect to
// points beside the line without crossing a depth jump. The distances in the result are those from the line.
//
// A lasso consists of the points that its closed line encloses when seen along the lasso's direction. Their
// normals face the viewer who drew the lasso, and they lie at most half of the lasso's size behind its
// deepest corner. So a lasso never changes parts that were hidden behind it when it was drawn, even if
// another view shows them.
//
// A region consists of the points that can be reached along edges from the point nearest to the stroke's
// point. Edges across depth jumps, and points at which the surface turns by more than the tolerance, are not
// passed. In lassos and regions, the distance is the radius minus the distance from the edge of the area, at
// least 0.
StrokePoints points_of(const Surface& surface, const Stroke& stroke);

}  // namespace relievo
