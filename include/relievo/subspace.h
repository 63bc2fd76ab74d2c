// The paper's subspace mode (stages 7, 8 and 10): reliefs from a few thousand control points, at a cost that
// hardly grows with the cloud. Close to ReliefModel's, not equal; the final output is that one's.
#pragma once

#include <vector>

#include "relievo/control_points.h"
#include "relievo/relief.h"
#include "relievo/spline.h"

namespace relievo {

struct SubspaceOptions {
  ControlPointOptions control;
  std::size_t normals_per_point = 8;  // most visible points whose slopes stand for a control point's region
  double cell = 1;                    // side of the spline's finest cells, in radii of the control points
  int levels = 5;                     // of the spline
  double damping = .01;               // of the spline, see SplineOptions
  double level_ratio = .01;  // below this share of the reference's height the ratio fades to the overall one
  double weight_power = 2;
  double max_slope = 4;               // of the reference heights
};

// Control points with their factored system, and the way from their heights to those of all points. Const
// calls may run concurrently.
class SubspaceModel {
 public:
  // What make() needs besides the model, so that a frame allocates nothing.
  struct Workspace {
    std::vector<Vec2> normal_slopes, slopes;
    std::vector<double> heights;
    std::vector<float> ratios;
    SplineFunction function;
    MultilevelSpline::Workspace fit;
  };

  // Prepares the model; copies what it needs of the surface. `reference` holds per point the reference heights
  // z0, (9) with w_k = 1; if it is empty they are solved for, once, by a HeightSystem of all points, which is
  // most of the cost. Errors: see HeightSystem::build(); kind cancelled.
  static Result<SubspaceModel> prepare(const Surface& surface, const SubspaceOptions& options = {},
                                       std::span<const double> reference = {}, Progress* progress = nullptr);

  std::size_t size() const { return reference_.size(); }
  const ControlPoints& control_points() const { return control_; }

  // Returns the relief of that shape, as ReliefModel::make() does.
  Relief make(const Shape& shape) const;

  Workspace make_workspace() const;

  // Writes the heights of that shape before detail. Allocates nothing.
  void heights(const Shape& shape, Workspace& workspace, std::span<float> heights) const;

 public:
  // The ratio z_c / z0_c of a control point is (z_c pull + rest * overall ratio).
  struct RatioTerm {
    float pull = 0, rest = 0;
  };

  SubspaceModel(HeightSystem system, MultilevelSpline spline)
      : system_(std::move(system)), spline_(std::move(spline)) {}
  void solve(const Shape& shape, Workspace& workspace) const;

  ControlPoints control_;
  std::vector<Index> region_begin_;  // normals of control point c: region_begin_[c] to region_begin_[c + 1]
  std::vector<Vec3f> region_normals_;
  std::vector<float> region_k_, region_boundary_weight_;
  double delta_ = 0;
  HeightSystem system_;  // of the control points

  std::vector<double> control_reference_;  // z0_c
  double level_sq_ = 0;
  MultilevelSpline spline_;
  std::vector<SplinePlace> places_;  // of all points
  std::vector<float> reference_;     // z0
  std::vector<float> k_, boundary_weight_;
};

}  // namespace relievo
