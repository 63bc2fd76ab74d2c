// Smooths the values at points of rows.
#pragma once

#include <span>
#include <vector>

#include "scan/outlines/row_points.h"

namespace relievo {

// Returns the values at points of rows, smoothed along each row. Depth, normal and curvature come from a
// quadratic that is fitted to the points of the same row within 3 rho; outliers have little weight. Points
// without a row and points with unknown values do not change.
std::vector<SideInterpolation::Value> smoothed_along_rows(std::span<const RowPoint> points,
                                                          std::vector<SideInterpolation::Value> values,
                                                          double rho);

}  // namespace relievo
