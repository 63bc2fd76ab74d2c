// Finds the visible points (stage 3) of a scattered cloud: points that no other points hide. Also finds
// points that replace unscanned parts of the visible side.
#pragma once

#include <span>
#include <vector>

#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"

namespace relievo {

// Returns the indices of the visible points, ascending. `viewed` is in view coordinates and has normals;
// without normals the result is empty.
//
// Every point that faces the viewer is drawn into a depth buffer as a disc. The disc is oriented by the
// normal, and its size follows from the local spacing, so that there are no gaps even if the density varies.
// A point is visible if it faces the viewer and is hardly behind the buffer's depth: by at most 2 local
// spacings, divided by the z of its normal. Small connected sets of points are not visible and hide nothing.
// In a height field all points that face the viewer are visible. The depth buffer replaces the cells of 2 rho
// in the paper's section 3.2, because these let hidden points through and lose points on slopes.
std::vector<Index> visible_points(const Cloud& viewed, const Spacing& spacing);

struct VisiblePoints {
  std::vector<Index> points;
  std::size_t removed = 0;  // number of otherwise visible points that were removed as floating noise
};

// Returns the result of visible_points(), and the number of removed points.
VisiblePoints find_visible(const Cloud& viewed, const Spacing& spacing);

// Returns the indices, ascending, of points that replace missing data. They face away from the viewer and
// have no visible point near them in the view plane: the scan contains the back of the model there, but not
// its front. With these points the relief has a flat spot there instead of a hole. Any two of the returned
// points are at least 0.7 rho apart.
std::vector<Index> hole_fill_points(const Cloud& viewed, const Spacing& spacing,
                                    std::span<const Index> visible);

}  // namespace relievo
