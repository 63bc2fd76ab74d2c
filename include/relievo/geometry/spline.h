// Fits multilevel B-splines, which are smooth functions of a position in the plane, to values at scattered
// sites. The sites are fixed; the values differ from function to function. Source: Lee, Wolberg and Shin,
// "Scattered Data Interpolation with Multilevel B-Splines", 1997.
//
// The functions are uniform cubic B-splines on lattices; the cells of a level are half as wide as those of
// the previous level. Each level is fitted to the residual of the coarser levels.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

struct SplineOptions {
  Vec2 min = Vec2::Zero(), max = Vec2::Ones();  // the domain; the function is constant beyond its edge
  double cell = .01;                            // width of the cells of the finest lattice, > 0
  // Number of lattices, [1, 16]; the cells of each are twice as wide as those of the next finer one.
  int levels = 5;
  // The levels from `first_fitted` to `last_fitted` are fitted; level 0 is the coarsest. A level outside this
  // range is not fitted; it represents the function of the coarser levels on its own, finer lattice.
  int first_fitted = 0, last_fitted = 15;
  // The damping that MultilevelSpline::fit() applies, as a multiple of the mean site weight, >= 0.
  double damping = 0;
};

// The position of a point on the finest lattice.
struct SplinePlace {
  Index node = 0;              // lower left node of the 4 x 4 nodes that influence the point
  std::uint16_t x = 0, y = 0;  // position in the middle cell of the 4 x 4 nodes, in units of 1/65536
};

// A function of a position in the plane: the sum of a constant and a uniform cubic B-spline.
struct SplineFunction {
  float mean = 0;
  std::vector<float> nodes;  // values at the nodes of the finest lattice, row by row
};

// Fits and evaluates functions given at fixed sites. Const calls may run concurrently.
class MultilevelSpline {
 public:
  // Scratch memory, so that fit() allocates nothing.
  struct Workspace {
    std::vector<float> rest;        // residual of the levels so far, per site
    std::vector<float> coarser;     // nodes of the previous level
    std::vector<float> correction;  // per node: correction by the current level
  };

  MultilevelSpline() : MultilevelSpline({}, {}, {}) {}  // without sites, all fitted functions are 0

  // Prepares fits at the sites. Each site has a weight >= 0. Only the ratios of the weights matter.
  MultilevelSpline(std::span<const Vec2> sites, std::span<const float> weights, const SplineOptions& options);

  // Returns the number of bytes of memory in use.
  std::size_t memory() const;

  SplineFunction make_function() const;
  Workspace make_workspace() const;

  // Overwrites the function with the fit to one value per site: the weighted mean of the values, corrected
  // level by level. Damping reduces corrections that few sites support: a node gets half of its correction if
  // the sum of the weights of the sites around it equals the damping. Nodes without nearby sites keep the
  // values of the coarser levels. If all weights are 0, the function is 0.
  void fit(std::span<const float> values, SplineFunction& function, Workspace& workspace) const;

  // Returns the points as positions on the finest lattice, which evaluate() needs.
  std::vector<SplinePlace> pack(std::span<const Vec2> points) const;

  // Writes the function's value at each position to `values`, which must have the same size as `places`.
  void evaluate(const SplineFunction& function, std::span<const SplinePlace> places,
                std::span<float> values) const;

  // Interleaves the node values of two functions, and overwrites `pair` with them. The functions may belong
  // to another spline with the same domain, cell size and number of levels.
  static void pair_up(const SplineFunction& a, const SplineFunction& b, std::vector<float>& pair);

  // The values of the functions a and b at given positions, without the means of these functions. The
  // following evaluate() writes one value of each function per position, on the calling thread only.
  struct PairValues {
    std::span<float> a, b;
  };
  void evaluate(std::span<const float> pair, std::span<const SplinePlace> places,
                const PairValues& values) const;

 private:
  struct Position {
    Index node = 0;
    float x = 0, y = 0;  // position in the middle cell of the 4 x 4 nodes, in [0, 1]
  };
  struct Site {
    Eigen::Array4f x, y;  // weights of the 4 nodes along each axis
    Index node = 0;
    float scale = 0;  // the site's weight divided by the sum of the squared node weights
  };
  struct Level {
    std::size_t columns = 0, rows = 0;  // numbers of nodes: cells + 3
    double cell = 0;
    std::vector<Site> sites;     // empty unless the level is fitted
    std::vector<float> inverse;  // per node: 1 / the sum of the weights of the sites around it
  };

  Position locate(const Level& level, const Vec2& point) const;
  void prepare(Level& level, std::span<const Vec2> sites, double damping) const;
  static void refine(const Level& coarse, std::vector<float>& nodes, std::vector<float>& copy);
  void correct(const Level& level, std::vector<float>& nodes, Workspace& workspace) const;

  Vec2 min_, max_;
  std::vector<float> weights_;
  double total_weight_ = 0;
  std::vector<Level> levels_;
};

}  // namespace relievo
