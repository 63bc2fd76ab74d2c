// The paper's frames as one would build them from stock parts: CHOLMOD's re-solve, a multilevel B-spline that
// is fitted and evaluated anew for every frame, the formulas point by point, one thread. To compare with.
#pragma once

#include <memory>
#include <vector>

#include "cholmod_system.h"
#include "relief/height_equations.h"
#include "relief/subspace/control_mesh.h"
#include "relievo/relief/weights.h"
#include "relievo/scan/surface.h"

namespace relievo {

// Milliseconds.
struct StockTimes {
  double t1 = 0, t2 = 0, t3 = 0;
};

// Slopes to heights, on all points or on control points.
class StockHeights {
 public:
  StockHeights(HeightEquations equations, const Surface& surface, std::vector<Index> points);

  // Heights of the points, 0 where they are not free.
  const std::vector<double>& solve(const Shape& shape);

 private:
  HeightEquations equations_;
  const Surface& surface_;
  std::vector<Index> points_;  // of the surface
  std::vector<float> boundary_weight_;
  CholmodSystem system_;
  std::vector<Vec2> slopes_;
  std::vector<double> b_, heights_;
};

// Section 3.2 of Lee, Wolberg and Shin, 1997, as printed: lattices that halve, each fitted to what the
// coarser ones leave, and the values of all added up.
class StockSpline {
 public:
  StockSpline(std::vector<Vec2> sites, double coarsest_cell, int levels);

  void fit(std::vector<double> values);
  double operator()(const Vec2& place) const;

 private:
  struct Lattice {
    double cell;
    std::size_t columns, rows;
    std::vector<double> nodes;
  };
  static double value(const Lattice& lattice, const Vec2& offset);
  void fit(Lattice& lattice, const std::vector<double>& rest) const;

  std::vector<Vec2> sites_;
  Vec2 min_, max_;
  std::vector<Lattice> lattices_;
};

// Frames by one of the two ways; the surface must outlive it.
class StockPipeline {
 public:
  // From control points whose reference heights, and those of all points, are solved for here.
  StockPipeline(const Surface& surface, const ControlPoints& control);
  // From all visible points.
  explicit StockPipeline(const Surface& surface);

  StockTimes make(const Shape& shape);

 private:
  void map();
  void add_detail(double gamma);
  void find_normals();

  const Surface& surface_;
  std::vector<Vec2> points_;
  std::unique_ptr<StockHeights> heights_;
  std::unique_ptr<StockSpline> spline_;  // null: no mapping
  const std::vector<double>* solved_ = nullptr;
  std::vector<double> reference_, control_reference_, z_;
  std::vector<float> boundary_weight_;
  std::vector<Vec3> normals_;
};

}  // namespace relievo
