// A membrane under a relief, spread between its silhouettes: added to the heights that equation (9) finds, it
// keeps them within a height asked for and changes their slopes no more than it must.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lattice.h"
#include "relievo/surface.h"

namespace relievo {

// Of all b with 0 <= z + b <= h, 0 from a cell beyond the silhouette on, the membrane is that with the least
// integral of |grad b|^2 + ((z + b - h r) / reach)^2, where r are the ranks of the depths: an obstacle
// problem. Where the heights z have room b is smooth, so that the relief keeps their curvature; what is in
// front is drawn to the front. It lives on a lattice of 1 % of the longer side, coarser where points are few,
// whose limits leave room for what the heights do between nodes. It is 0 where there are no points. Const
// calls may run concurrently, each with a workspace of its own.
class Membrane {
 public:
  static constexpr double reach = .11;  // of the longer side

  // What spread() needs besides, and finds, so that it allocates nothing.
  struct Workspace {
    std::vector<Lattice::Corners> sums;                   // per cell
    std::vector<Lattice::Extent> rests;                   // per cell
    std::vector<float> heights, lowest, highest, wanted;  // per node
    std::vector<float> membrane, smoothed;

    std::size_t memory() const;
  };

  // Copies what it needs of the surface.
  explicit Membrane(const Surface& surface);

  Workspace make_workspace() const;

  // Bytes held, workspaces not counted.
  std::size_t memory() const;

  // Finds the membrane for heights, one per point, and `height` > 0; the workspace holds it. A few points may
  // still be a little out of the limits, for it is smoothed, and where heights are rougher than `height` it
  // shares the excess between both ends. Same bits for any number of threads. For float and double.
  template <typename Real>
  void spread(std::span<const Real> heights, double height, Workspace& workspace) const;

  // The membrane's height at a point, for heights that it was spread for.
  float at(std::size_t point, const Workspace& workspace) const {
    return lattice_.at(point, workspace.membrane);
  }

  // Heights, one per point, with w_b, and the height that they are to have.
  template <typename Real>
  struct Heights {
    std::span<Real> values;
    std::span<const float> boundary_weight;
    double height;
  };

  // Spreads the membrane, adds it to the heights, rounds off the few that are highest or lowest and gives
  // them just the height, base included. Heights that are all 0 and a height of 0 change nothing. For float
  // and double.
  template <typename Real>
  void hold(const Heights<Real>& heights, Workspace& workspace) const;

 private:
  void set_limits(float height, Workspace& w) const;
  void relax(Workspace& w) const;
  void smooth(Workspace& w) const;
  Lattice::Extent rest_around(std::size_t node, const Workspace& w) const;

  Lattice lattice_;
  float pull_ = 0;                            // towards the ranks: (cell / reach)^2
  std::vector<float> ranks_;                  // per node
  std::array<std::vector<Index>, 2> active_;  // nodes, red and black
};

// The height within which a layered relief is held, of the one that (9) gives its slopes: the less is kept of
// them, the more of the height is taken. `u` is that of Compression.
double held_share(double u);

}  // namespace relievo
