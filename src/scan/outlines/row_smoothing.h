// Tested by tests/scan/row_smoothing_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "scan/outlines/row_points.h"

namespace relievo {

// Returns the values at points of rows after their scatter along each row is smoothed away: depth, normal and
// curvature come from a quadratic fitted to the points up to 3 rho away in the same row, in which outliers count
// little. Points of no row, and those whose values are unknown, keep what they have.
std::vector<SideInterpolation::Value> smoothed_along_rows(std::span<const RowPoint> points,
                                                          std::vector<SideInterpolation::Value> values,
                                                          double rho);

}  // namespace relievo
