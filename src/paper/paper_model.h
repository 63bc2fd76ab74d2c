// Makes reliefs exactly by the paper (sections 3.3 to 3.5), from a surface that is prepared once.
#pragma once

#include <optional>

#include "paper/compression.h"
#include "paper/heights.h"
#include "paper/mapping.h"
#include "relievo/core/progress.h"
#include "relievo/scan/surface.h"

namespace relievo {

// Solves the system (9), which is factored once. The unknowns are the heights of all visible points, or only
// those of the control points; then map() computes the heights of all visible points. Const calls may run
// concurrently if each has its own workspace.
class PaperModel {
 public:
  // Scratch memory, so that solve() and map() allocate nothing.
  struct SolveWorkspace {
    paper::NormalEquations::Workspace system;
    std::vector<Vec2f> slopes;
  };
  using MapWorkspace = paper::HeightMapping::Workspace;

  // Factors the system for a surface from paper::find_surface(). `control_points` is the paper's n2, see
  // paper::control_points(). If it is not less than the number of visible points, all of them are control
  // points. Errors: those of NormalEquations::build(); kind cancelled.
  static Result<PaperModel> prepare(const Surface& surface, std::size_t control_points,
                                    Progress* progress = nullptr);

  // size() returns the number of visible points. control_points() returns the number of control points.
  std::size_t size() const { return k_.size(); }
  std::size_t control_points() const { return system_.size(); }
  bool is_subspace() const { return mapping_.has_value(); }
  std::size_t memory() const;
  SolveWorkspace make_solve_workspace() const;
  MapWorkspace make_map_workspace() const;

  // Writes the heights of the control points, by (5) to (9).
  void solve(const paper::Coefficients& coefficients, SolveWorkspace& workspace,
             std::span<float> control_heights) const;

  // Writes the heights of all visible points, given those of the control points. Adds detail by the paper's
  // second equation (9): z_p += gamma k_p h. Here h, the height without detail, is the size of the range that
  // contains 0 and all z. Then boundary points are set to 0, because (9) only brings them close to 0, and a
  // plate must be closed.
  void map(std::span<const float> control_heights, double gamma, MapWorkspace& workspace,
           std::span<float> heights) const;

 private:
  explicit PaperModel(paper::NormalEquations system) : system_(std::move(system)) {}

  struct ControlPoint {
    Vec3f normal;
    float k = 0, distance = 0;  // `distance`: from the point to the boundary
  };

  paper::NormalEquations system_;
  std::vector<ControlPoint> control_;
  std::vector<float> k_;         // normalised mean curvature of all visible points
  std::vector<Index> boundary_;  // P_b, the boundary points
  double delta_ = 0, rho_ = 0;
  std::optional<paper::HeightMapping> mapping_;
};

}  // namespace relievo
