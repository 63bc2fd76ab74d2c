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

// The edges and areas of a surface that its blurs need.
struct SurfaceLinks {
  struct Link {
    Index to;
    float weight;  // edge_weight()
  };
  Groups<Link> links;        // around each point: the edges inside the relief that are no depth jumps
  std::vector<float> areas;  // a third of the area of the triangles around each point, in the view plane
};

// Returns the links and areas of all points of the surface.
SurfaceLinks surface_links(const Surface& surface);

// Computes the difference between heights and their blur at some points. The blur keeps the heights around the points,
// and does not cross depth jumps. `Real` is the type of the heights.
template <typename Real>
class StrokeBlur {
 public:
  // `sigma` is the standard deviation of the blur, in the units of the surface.
  StrokeBlur(const Surface& surface, const SurfaceLinks& links, std::span<const Index> points, double sigma);

  // Computes removed() for the heights z of all points of the surface.
  void take(std::span<const Real> z);

  // Returns z minus blurred z, one per point; empty before the first take().
  const std::vector<Real>& removed() const { return removed_; }

 private:
  // A link from a point, or from one around the points, to a point. Numbers are those in points_, then in around_.
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

// Moves the heights under a stroke, by their weights times `amount`, towards the uncorrected heights plus the plane
// that fits the height correction best. If that exceeds the height of the relief anywhere, the plane is lower. The mask
// must not be empty. Instantiated for float and double.
template <typename Real>
void protect(const CorrectedHeights<Real>& heights, const StrokeMask& mask, double amount);

// An edge from a point of a mask across a depth jump.
struct Crossing {
  Index from;    // number of the point in the mask
  Index behind;  // the point of the surface behind it
};

// Returns the edges from points of a mask, with at least half of the weight, across depth jumps to points behind it
// that are not in the mask.
std::vector<Crossing> crossings_of(const Surface& surface, const StrokeMask& mask);

// The heights by which a stroke is to stand above the surface behind it.
template <typename Real>
struct InFront {
  std::span<const Crossing> crossings;
  Real step;    // least rise of each crossing
  Real height;  // of the relief
};

// Raises the heights z under a stroke by their weights times r (1 - z / height), so that nothing exceeds the height and
// higher points stay higher. r is the least value with which all crossings have their step; it is at most the height,
// which may be too little for points near the top. Instantiated for float and double.
template <typename Real>
void bring_forward(const InFront<Real>& wanted, const StrokeMask& mask, std::span<Real> z);

// Returns the mask of a stroke: its points_of(). At distance d the weight is (1 - x^2)^2, where x rises from 0 to 1 over
// the outer part `softness` of the radius. Near the boundary the weight fades like w_b of (7). The mask is empty if the
// visible surface has no point of the stroke.
StrokeMask stroke_mask(const Surface& surface, const Stroke& stroke);

// The strokes of a relief on one surface, which must outlive this object. `Real` is the type of the heights.
template <typename Real>
class StrokeFields {
 public:
  explicit StrokeFields(const Surface& surface) : surface_(&surface) {}

  // Takes these strokes in place of the former ones. Strokes that did not change keep their masks and systems, so that
  // a stroke that is being drawn costs little more than itself.
  void take(const Strokes& strokes);

  bool empty() const { return changed_.empty(); }

  // Changes the heights z of a relief of the given height, in the surface's units. `uncorrected` has the heights
  // before the height correction, for Brush::protect; if it is empty, that brush changes nothing. Heights outside of
  // the strokes keep their values. No height falls below the base, 0. The highest point may change; the caller then
  // restores the height.
  void apply(double height, std::span<const Real> uncorrected, std::span<Real> z);

 private:
  // The share of the detail removed by a stroke's blur that is added to one point.
  struct Share {
    Index at;  // number of the point in changed_
    Real share;
  };
  struct Layer {
    Stroke stroke;
    StrokeMask mask;                       // empty for muted strokes
    std::optional<StrokeBlur<Real>> blur;  // of brushes that need it
    std::vector<Crossing> crossings;       // of Brush::in_front
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
  std::optional<SurfaceLinks> links_;  // once a blur needs them
  std::vector<Layer> layers_;          // one per stroke
  std::vector<Index> changed_;         // the points under at least one stroke
  std::vector<Real> blurred_;          // the heights of which the blurs are known
  // One per point of changed_: the shares of the height that strokes raise it, and scratch memory for what they add.
  std::vector<Real> risen_, added_;
};

// Returns whether apply() needs the uncorrected heights for these strokes.
bool needs_uncorrected(const SharedStrokes& strokes);

// Applies the strokes of the relief's shape to its heights, and restores the height of the relief. `uncorrected` is that
// of apply().
void apply_strokes(const Surface& surface, std::span<const double> uncorrected, Relief& relief);

// Points of an area, and the distance of each from where the change is full: in [0, the stroke's radius).
struct StrokePoints {
  std::vector<Index> points;
  std::vector<double> distances;
};

// Returns the points of a stroke, without those on the boundary; none if the view does not show the stroke.
//
// A line has the points that are nearer than the radius in space, and connected to points beside it without crossing a
// depth jump. Distances are those from the line.
//
// A lasso has the points that its closed line encloses, seen along its direction, whose normals face
// its viewer, and which are not deeper than its deepest corner by more than half of its size. So in other views it
// does not change what was hidden behind it.
//
// A region has the points that can be reached from the point nearest to its own without crossing a depth jump, and
// without points at which the surface turns by more than the tolerance. In lassos and regions, the distance is the
// radius minus the distance from the edge, at least 0.
StrokePoints points_of(const Surface& surface, const Stroke& stroke);

}  // namespace relievo
