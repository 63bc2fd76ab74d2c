// Multilevel B-splines: a smooth function of the plane through scattered values, at places fixed beforehand.
//
// Lee, Wolberg and Shin, "Scattered Data Interpolation with Multilevel B-Splines", 1997: uniform cubic
// B-splines on lattices whose cells halve from level to level, each fitted to what the coarser ones leave.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

struct SplineOptions {
  Vec2 min = Vec2::Zero(), max = Vec2::Ones();  // the domain; other places take the value at its edge
  double cell = .01;                            // side of the finest lattice's cells, > 0
  int levels = 5;  // number of lattices, [1, 16]; cells are twice as wide from each to the next coarser
  int first_fitted = 0,
      last_fitted = 15;  // levels that are fitted, the coarsest is 0; others are only refined
  double damping = 0;    // share of the mean weight of the sites, >= 0: see MultilevelSpline::fit()
};

// A place in the finest lattice.
struct SplinePlace {
  Index node = 0;              // lower left of the 4 x 4 nodes that count
  std::uint16_t x = 0, y = 0;  // position in the middle one of their cells, in 65536ths
};

// The function: mean plus a uniform cubic B-spline.
struct SplineFunction {
  float mean = 0;
  std::vector<float> nodes;  // of the finest lattice, row by row
};

// Fits and evaluates functions given at fixed sites. Const calls may run concurrently.
class MultilevelSpline {
 public:
  // What a fit needs besides the function, so that it allocates nothing.
  struct Workspace {
    std::vector<float> rest;        // per site, what the levels so far leave
    std::vector<float> coarser;     // nodes of the level before
    std::vector<float> correction;  // per node
  };

  MultilevelSpline() : MultilevelSpline({}, {}, {}) {}  // no sites: the function is 0

  // Prepares fits at the sites, each of a weight >= 0: how much it counts against its neighbours.
  MultilevelSpline(std::span<const Vec2> sites, std::span<const float> weights, const SplineOptions& options);

  // Bytes held.
  std::size_t memory() const;

  SplineFunction make_function() const;
  Workspace make_workspace() const;

  // Overwrites the function with the fit to one value per site: their weighted mean, corrected level by
  // level. A node's correction shrinks to a half where the weight around it is the damping; where there is
  // none the function keeps what the coarser levels say. All sites of weight 0: the function is 0.
  void fit(std::span<const float> values, SplineFunction& function, Workspace& workspace) const;

  std::vector<SplinePlace> pack(std::span<const Vec2> points) const;

  // Writes the function's value at each place.
  void evaluate(const SplineFunction& function, std::span<const SplinePlace> places,
                std::span<float> values) const;

  // Overwrites `pair` with two functions, which may be those of another spline with the same domain, cell and
  // levels: at each node both, side by side.
  static void pair_up(const SplineFunction& a, const SplineFunction& b, std::vector<float>& pair);

  // Writes the values of both at each place, less their means; in the calling thread alone.
  struct PairValues {
    std::span<float> a, b;
  };
  void evaluate(std::span<const float> pair, std::span<const SplinePlace> places,
                const PairValues& values) const;

 private:
  struct Position {
    Index node = 0;
    float x = 0, y = 0;  // in the middle cell, [0, 1]
  };
  struct Site {
    Eigen::Array4f x, y;  // weights of the nodes
    Index node = 0;
    float scale = 0;  // the site's weight over the sum of the squares of those
  };
  struct Level {
    std::size_t columns = 0, rows = 0;  // of nodes: cells + 3
    double cell = 0;
    std::vector<Site> sites;     // none unless the level is fitted
    std::vector<float> inverse;  // per node, of the weight around it
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
