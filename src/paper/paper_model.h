// Reliefs by the paper to the letter (sections 3.3 to 3.5), from a surface that is prepared once.
#pragma once

#include <optional>

#include "paper/compression.h"
#include "paper/heights.h"
#include "paper/mapping.h"
#include "relievo/core/progress.h"
#include "relievo/scan/surface.h"

namespace relievo {

// The system (9) of all visible points, or of the control points with the mapping to all visible points. Const
// calls may run concurrently, each with a workspace of its own.
class PaperModel {
 public:
  // Scratch memory of solve() and of map(), so that frames allocate nothing.
  struct SolveWorkspace {
    paper::NormalEquations::Workspace system;
    std::vector<Vec2f> slopes;
  };
  using MapWorkspace = paper::HeightMapping::Workspace;

  // Factors the system of the surface of paper::find_surface(). `control_points` is the paper's n2, see
  // paper::control_points(); if it is not less than the number of visible points, all of these are control
  // points. Errors: see NormalEquations::build(); kind cancelled.
  static Result<PaperModel> prepare(const Surface& surface, std::size_t control_points,
                                    Progress* progress = nullptr);

  // Returns the number of visible points, and that of control points.
  std::size_t size() const { return k_.size(); }
  std::size_t control_points() const { return system_.size(); }
  bool is_subspace() const { return mapping_.has_value(); }
  std::size_t memory() const;
  SolveWorkspace make_solve_workspace() const;
  MapWorkspace make_map_workspace() const;

  // Writes the heights of the control points, by (5) to (9).
  void solve(const paper::Coefficients& coefficients, SolveWorkspace& workspace,
             std::span<float> control_heights) const;

  // Writes the heights of all visible points for those of the control points, with detail, the paper's second
  // equation (9): z_p += gamma k_p h. Here h is the height without detail, highest minus lowest of z and 0.
  // Boundary points are then put on the base, near which the rows of (9) only keep them: a plate must be closed.
  void map(std::span<const float> control_heights, double gamma, MapWorkspace& workspace,
           std::span<float> heights) const;

 private:
  explicit PaperModel(paper::NormalEquations system) : system_(std::move(system)) {}

  struct ControlPoint {
    Vec3f normal;
    float k = 0, distance = 0;  // to the boundary
  };

  paper::NormalEquations system_;
  std::vector<ControlPoint> control_;
  std::vector<float> k_;         // normalised mean curvature of all visible points
  std::vector<Index> boundary_;  // P_b
  double delta_ = 0, rho_ = 0;
  std::optional<paper::HeightMapping> mapping_;
};

}  // namespace relievo
