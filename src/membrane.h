// A stiff membrane under a relief, spread between its silhouettes: added to the heights that equation (9)
// finds, it keeps them within a height asked for and changes their slopes and curvature no more than it must.
#pragma once

#include <span>
#include <vector>

#include "geometry/lattice.h"
#include "relievo/relief/layers.h"
#include "relievo/scan/surface.h"
#include "solver/obstacle_solver.h"

namespace relievo {

// Of all b with 0 <= z + b <= h, 0 from a cell beyond the silhouette on, the membrane is about that with the
// least integral of (stiff_reach lap b)^2 + w |grad b|^2 + ((z + b - h r) / reach)^2, where r are the ranks
// of the depths and w what slopes count for in (9), less than 1 near jumps: an obstacle problem. Of |grad
// b|^2 across the silhouette only `anchor` counts. Where the heights z have room b is smooth, so that the
// relief keeps their curvature; along silhouettes and depth jumps it is hinged, for nobody sees it bend
// there; what is in front is drawn to the front. It lives on a lattice of .7 % of the longer side, coarser
// where points are few, whose limits leave room for what the heights do between nodes. It is 0 where there
// are no points. Const calls may run concurrently, each with a workspace of its own.
class Membrane {
 public:
  static constexpr double stiff_reach = .028;  // of the longer side

  // What spread() needs besides, and finds, so that it allocates nothing.
  struct Workspace {
    std::vector<Lattice::Corners> sums;  // per cell
    std::vector<Lattice::Extent> rests;  // per cell
    std::vector<float> heights;          // per node
    ElasticSheet::Workspace sheet;
    std::vector<Lattice::Tile> tiles;  // per node

    std::size_t memory() const;
  };

  // Copies what it needs of the surface and of jump_weights() of it.
  Membrane(const Surface& surface, std::span<const float> jump_weights);

  Workspace make_workspace() const;

  // Bytes held, workspaces not counted.
  std::size_t memory() const;

  // Between what heights are to be held, how hard they are drawn towards the ranks and, at the silhouette,
  // to the ground.
  struct Limits {
    double height;      // > 0
    double reach;       // of the longer side, > 0
    double anchor = 1;  // (0, 1]

    // As the hold asks.
    static Limits of(double height, const Hold& hold);
  };

  // Finds the membrane for heights, one per point; the workspace holds it. A few points may still be a little
  // out of the limits, for it is smooth, and where heights are rougher than `height` it shares the excess
  // between both ends. Same bits for any number of threads. For float and double.
  template <typename Real>
  void spread(std::span<const Real> heights, const Limits& limits, Workspace& workspace) const;

  // The two halves of spread(), to find it for several limits of the same heights.
  template <typename Real>
  void gather(std::span<const Real> heights, Workspace& workspace) const;
  void settle(const Limits& limits, Workspace& workspace) const;

  // The membrane's height at a point, for heights that it was spread for.
  float at(std::size_t point, const Workspace& workspace) const {
    return lattice_.at(point, workspace.tiles);
  }

  // Heights, one per point, with w_b, and what they are to be held within: a height of 0, too.
  template <typename Real>
  struct Heights {
    std::span<Real> values;
    std::span<const float> boundary_weight;
    Limits limits;
  };

  // Spreads the membrane, adds it to the heights, rounds off the few that are highest or lowest and gives
  // them just the height, base included. A height of 0 changes nothing. For float and double.
  template <typename Real>
  void hold(const Heights<Real>& heights, Workspace& workspace) const;

 private:
  Membrane(const Surface& surface, std::span<const float> jump_weights, double longer_side);
  void set_limits(float height, float pull, Workspace& w) const;
  Lattice::Extent rest_around(std::size_t node, const Workspace& w) const;

  double side_, cell_;
  Lattice lattice_;
  ElasticSheet sheet_;
  std::vector<float> ranks_;  // per node
};

}  // namespace relievo
