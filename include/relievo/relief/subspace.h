// Our subspace mode makes reliefs from a few thousand control points. It follows the subspace mode of the
// paper (stages 7, 8 and 10). The time for a relief depends little on the size of the cloud.
// src/paper/mapping.h has the paper's own mapping.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "relievo/geometry/spline.h"
#include "relievo/relief/control_points.h"
#include "relievo/relief/heights.h"
#include "relievo/relief/weights.h"
#include "relievo/scan/surface.h"

namespace relievo {

struct SubspaceOptions {
  ControlPointOptions control;
  // Number of samples that determine the mean slope of a control point, > 0.
  std::size_t normals_per_point = 8;
  double max_slope = 4;  // slope limit of the reference heights, see Shape
};

// Returns z_ref: the heights of all points from (9) with w_k = 1. `system` is the system of all points.
std::vector<double> reference_heights(const Surface& surface, const HeightSystem& system, double max_slope);

// Control points with their factored system. At the control points, (9) is solved twice: with w_k = 1 for
// the reference height z_ref, and with the weights w_k for the compressed height. The ratio is a smooth
// approximation of the compressed height divided by z_ref. The offset is the rest of the compressed height,
// mainly where z_ref crosses 0. Multilevel B-splines extend ratio and offset to all points, and the height of
// any point is z = ratio z_ref + offset.
//
// The heights differ from those of exact mode by about 1 % of the relief's height (root mean square), or by 1
// to 4 % in layered reliefs. Low reliefs differ most (docs/decisions/subspace.md). Const calls may run
// concurrently if each has its own workspace.
class SubspaceModel {
 public:
  // Scratch memory, so that frames allocate nothing.
  class Workspace {
   public:
    Workspace(Workspace&&) noexcept;
    Workspace& operator=(Workspace&&) noexcept;
    ~Workspace();

    // Returns the number of bytes of memory in use, except for a few bytes per control point.
    std::size_t memory() const;

   private:
    friend class SubspaceModel;
    struct Storage;
    explicit Workspace(std::unique_ptr<Storage> storage);
    std::unique_ptr<Storage> storage_;
  };

  // Results that the caller may already have. prepare() computes those that are empty.
  struct Known {
    std::span<const double> reference = {};    // reference_heights() for the same max_slope as in the options
    std::span<const PointLayers> layers = {};  // normal_layers() of the surface
  };

  // Copies the data that it needs from the surface. The reference heights take most of the time and memory.
  // Errors: those of HeightSystem::build(); kind cancelled.
  static Result<SubspaceModel> prepare(const Surface& surface, const SubspaceOptions& options,
                                       const Known& known, Progress* progress = nullptr);
  static Result<SubspaceModel> prepare(const Surface& surface, const SubspaceOptions& options = {}) {
    return prepare(surface, options, {});
  }

  // Returns the number of points of the surface.
  std::size_t size() const { return reference_.size(); }

  const ControlPoints& control_points() const { return control_; }

  // Returns the number of bytes of memory in use.
  std::size_t memory() const;

  Workspace make_workspace() const;

  // Solves for the heights of the control points. `boundary_weight` is w_b per point of the surface, for the
  // shape's boundary width.
  void solve(const Shape& shape, std::span<const float> boundary_weight, Workspace& workspace) const;

  // Extends the solution to all points: writes their heights above the base, without detail.
  void carry(std::span<const float> boundary_weight, Workspace& workspace, std::span<float> heights) const;

 private:
  // Normals sampled from the regions of the control points, the same number from each.
  struct Samples {
    std::vector<Vec3f> normals;
    std::vector<float> k;
    std::vector<PointLayers> layers;
    std::vector<Index> points;  // the sampled points
  };
  // The ratio of a control point c is z_c * own + common * overall. z_c is its height; `common` is the same
  // for all control points.
  struct RatioTerm {
    float own = 0, overall = 0;
  };

  SubspaceModel(HeightSystem system, Samples samples, double delta);
  void fit(Workspace::Storage& storage) const;
  void set_reference(double max_slope, std::span<const float> boundary_weight);
  void set_splines(std::span<const Vec2> sites, std::span<const Vec2> points);

  ControlPoints control_;
  HeightSystem system_;
  Samples samples_;
  double delta_ = 0;

  std::vector<float> control_reference_;  // reference heights of the control points
  std::vector<RatioTerm> ratio_terms_;
  MultilevelSpline ratio_spline_, offset_spline_;
  std::vector<SplinePlace> places_;
  std::vector<float> reference_;  // z_ref of all points
};

}  // namespace relievo
