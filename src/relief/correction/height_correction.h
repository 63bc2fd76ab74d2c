// Computes the height correction: a smooth field that compresses the heights of a layered relief to the
// height asked for.
#pragma once

#include <span>
#include <vector>

#include "geometry/lattice.h"
#include "relievo/relief/shape.h"
#include "relievo/scan/surface.h"
#include "solver/obstacle_solver.h"

namespace relievo {

// The limits of corrected heights, and the stiffness of the ties at the silhouette.
struct HeightLimits {
  double height;  // > 0; corrected heights lie between 0 and this height
  // (0, 1]; stiffness of the ties that pull the field to 0 along the silhouette
  double boundary_stiffness = 1;
  // Shape::planes: the field keeps the silhouette above the base by this share of the height.
  double planes = 0;

  // Returns the limits for this height and the shape's other parameters.
  static HeightLimits of(double height, const Shape& shape);
};

// A field b that is added to the heights z of equation (9), so that 0 <= z + b <= h. Among all such fields b
// approximates the one with the least energy (docs/method.md, "The height correction").
//
// b is given at the nodes of a lattice with cells of 0.7 % of the longer side, or wider cells if points are
// sparse. The limits at the nodes leave room for the heights between them. The energy pulls near parts in
// front of farther parts beside them (near order). Along the silhouette, springs (solver::Tie) pull b to 0,
// and stiffer springs raise b where it is below the share HeightLimits::planes of the height. The lattice
// continues beyond the silhouette, so that b does not depend on the position of the silhouette between nodes.
//
// Const calls may run concurrently if each has its own workspace. Results are the same bits for any number of
// threads.
class HeightCorrection {
 public:
  // The bending length of b, as a share of the longer side (docs/decisions/height-correction.md).
  static constexpr double bending_length = .05;

  // Scratch memory and the result of fit(), so that calls allocate nothing.
  struct Workspace {
    std::vector<Lattice::Corners> sums;  // per cell
    std::vector<Lattice::Extent> rests;  // per cell
    std::vector<float> heights;          // per node
    solver::ObstacleSolver::Workspace sheet;
    std::vector<Lattice::Tile> tiles;  // per node

    std::size_t memory() const;
  };

  // Copies all data that it needs from the surface.
  explicit HeightCorrection(const Surface& surface);

  Workspace make_workspace() const;

  // Returns the bytes of memory in use, without workspaces.
  std::size_t memory() const;

  // Finds b for heights, one per point, and stores it in the workspace. Because b is smooth, a few points may
  // stay slightly outside the limits. If the heights around a node span more than the height limit, the
  // corrected heights exceed both limits by the same amount. Instantiated for float and double.
  template <typename Real>
  void fit(std::span<const Real> heights, const HeightLimits& limits, Workspace& workspace) const;

  // Returns b at a point, after fit().
  float at(std::size_t point, const Workspace& workspace) const {
    return lattice_.at(point, workspace.tiles);
  }

  // The heights and weights w_b, one per point each, and the limits that the heights are compressed to.
  template <typename Real>
  struct Heights {
    std::span<Real> values;
    std::span<const float> boundary_weight;
    HeightLimits limits;
  };

  // Adds b to the heights, clips the few highest and lowest heights softly (SoftClip), and scales the result
  // to exactly HeightLimits::height, measured from the base. Does nothing if that height is 0 or all heights
  // are 0. Instantiated for float and double.
  template <typename Real>
  void compress_heights(const Heights<Real>& heights, Workspace& workspace) const;

 private:
  void set_limits(float height, Workspace& w) const;
  Lattice::Extent rest_around(std::size_t node, const Workspace& w) const;

  double side_, cell_;
  Lattice lattice_;
  std::vector<float> coverage_;  // per node: share of the lattice around it that the surface covers
  solver::ObstacleSolver sheet_;
};

}  // namespace relievo
