// Gives models of a scene the heights that they were asked to have over what is behind them.
// Tested by tests/relief/own_heights_test.cpp.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "relievo/core/types.h"
#include "relievo/solver/cholesky.h"

namespace relievo {

struct Surface;

// The models of a scene with heights of their own, see Pose::height. Models of the same height count as one.
//
// The heights around a model, and the base where the model meets it, are continued behind the model by the
// surface without curvature (harmonic). The model's heights over that surface are scaled until the highest of
// them is the one asked for, but not beyond the depth of the model itself. What is still missing is a wall
// along the model's edge, as high everywhere: letters, which are level, consist of that alone.
//
// All other heights keep their values, unless the highest point of the relief changes: then they are scaled, so
// that the relief keeps its height.
class OwnHeights {
 public:
  // Scratch memory, so that frames allocate nothing.
  template <typename Real>
  struct Workspace {
    std::vector<Real> before, over;
    std::vector<solver::Cholesky::Workspace> solvers;
  };

  // Errors: those of solver::Cholesky::factor(), which the triangulation of a surface does not cause.
  static Result<OwnHeights> find(const Surface& surface);

  bool empty() const { return models_.empty(); }
  std::size_t memory() const;

  // Changes the heights z of a relief of that height, in the surface's units. Walls along the edges of models
  // rise by at most `wall_slope`.
  template <typename Real>
  void apply(double height, std::span<Real> z, Workspace<Real>& workspace,
             double wall_slope = std::numeric_limits<double>::infinity()) const;

 private:
  struct Link {
    Index a, b;
    float weight;
  };
  struct Model {
    double share = 0;              // height, as a share of the relief's
    double depth = 0;              // extent in depth of its connected parts, in the surface's units
    std::vector<Index> points;     // those that are not on the base
    std::vector<float> distances;  // of the points from the model's edge in the view plane
    std::vector<Link> links;       // edges with at least one end in `points`
    solver::Cholesky laplacian;
  };
  // The highest point of a relief, and the height there of what is scaled together with the other models.
  struct Top {
    double z = 0, scaled = 0;
  };

  // The height of the relief, and the largest slope of walls.
  struct Limits {
    double height, wall_slope;
  };

  static Result<Model> model_of(const Surface& surface, float share);

  // Raises one model over what is behind it. Returns its highest point.
  template <typename Real>
  Top raise(std::size_t model, const Limits& limits, std::span<Real> z, Workspace<Real>& workspace) const;

  std::vector<Model> models_;         // the farthest first
  std::vector<std::uint8_t> is_own_;  // per point, whether it belongs to one of `models_`
};

}  // namespace relievo
