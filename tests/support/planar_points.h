// Makes sets of points in the plane, regular and random, for tests of the triangulation.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

inline double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

// Returns uniformly distributed points in the unit square. For the seeds and sizes that tests use, no four of
// the points are cocircular and no three are collinear.
inline std::vector<Vec2> random_points(std::size_t n, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  std::vector<Vec2> points(n);
  for (Vec2& p : points) p = Vec2(uniform(random), uniform(random));
  return points;
}

inline std::vector<Vec2> grid_points(int width, int height) {
  std::vector<Vec2> points;
  for (int i = 0; i < width * height; ++i) points.emplace_back(i % width, i / width);
  return points;
}

inline std::vector<Vec2> circle_points(int n) {
  std::vector<Vec2> points;
  for (int i = 0; i < n; ++i) points.emplace_back(std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n));
  return points;
}

// Returns points of which half are uniformly distributed. The other half is scaled towards the origin by up
// to 15 powers of ten.
inline std::vector<Vec2> clustered_points(std::size_t n) {
  std::vector<Vec2> points = random_points(n, 2);
  for (std::size_t i = 0; i < n / 2; ++i) points[i] *= std::pow(10.0, -static_cast<double>(i % 16));
  return points;
}

}  // namespace relievo
