// Sets the heights of single models of a scene, each above the surface behind it.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "relief/edge_weight.h"
#include "relievo/core/types.h"
#include "relievo/solver/cholesky.h"

namespace relievo {

struct Surface;

// The models of a scene that have a requested height of their own (Pose::height). Models with the same height
// are treated as one.
//
// Behind each model, a harmonic surface continues the heights around the model. The model's heights above
// this surface are scaled until their maximum is the requested height or, if the depth of the model itself is
// less, this depth. In the second case, a wall of constant height along the model's edge adds the rest of the
// requested height. A level model, such as a letter, consists of its wall alone.
//
// If the highest height of the relief changes, the heights outside of these models are scaled until the
// highest height is the same as before. Otherwise the heights outside of these models keep their values.
class OwnHeights {
 public:
  // Scratch memory, so that frames allocate nothing.
  template <typename Real>
  struct Workspace {
    std::vector<Real> before, over;
    std::vector<solver::Cholesky::Workspace> solvers;
  };

  // Fails only if solver::Cholesky::factor() fails, which does not happen for the triangulation of a surface.
  static Result<OwnHeights> find(const Surface& surface);

  bool empty() const { return models_.empty(); }
  std::size_t memory() const;

  // Changes the heights z of a relief of the given height, in the surface's units. Walls along the edges of
  // models have slopes of at most `wall_slope`.
  template <typename Real>
  void apply(double height, std::span<Real> z, Workspace<Real>& workspace,
             double wall_slope = std::numeric_limits<double>::infinity()) const;

 private:
  struct Model {
    double share = 0;                 // requested height, as a share of the relief's height
    double depth = 0;                 // largest extent in depth of a connected part, in the surface's units
    std::vector<Index> points;        // the model's points except boundary points
    std::vector<float> distances;     // distance of each point from the model's edge in the view plane
    std::vector<WeightedLink> links;  // edges with at least one end in `points`
    solver::Cholesky laplacian;
  };
  // The highest height of a relief. `z` is this height. `scaled` is the part of `z` that is proportional to
  // the factor by which the heights outside of these models are multiplied.
  struct Top {
    double z = 0, scaled = 0;
  };

  // The height of the relief, and the largest slope of walls.
  struct Limits {
    double height, wall_slope;
  };

  static Result<Model> model_of(const Surface& surface, float share);

  // Sets the height of one model above the surface behind it. Returns its highest point.
  template <typename Real>
  Top raise(std::size_t model, const Limits& limits, std::span<Real> z, Workspace<Real>& workspace) const;

  std::vector<Model> models_;         // farthest first
  std::vector<std::uint8_t> is_own_;  // per point: whether it belongs to one of `models_`
};

}  // namespace relievo
