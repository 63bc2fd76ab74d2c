// Declares functions that several baselines share.
#pragma once

#include "relievo/relief/baselines.h"
#include "relievo/relief/heights.h"
#include "relievo/relief/relief.h"
#include "relievo/scan/surface.h"

namespace relievo {

// Returns the relief with these heights, one per point, after setting boundary points to 0 and scaling all
// heights so that the highest is `height`. All baselines end with this call.
Relief scaled_relief(std::vector<double> heights, const Surface& surface, double height);

// Returns the height of each point above the deepest point of the surface.
std::vector<double> depths(const Surface& surface);

// Returns the slope of a normal, shortened to at most the slope of 76 degrees, the default of
// Shape::max_slope. Without this limit, a few steep slopes at silhouettes would take most of the height.
Vec2 moderate_slope(const Vec3f& normal);

// The following functions return heights for scaled_relief().
std::vector<double> gradient_heights(const Surface& surface, const HeightSystem& system,
                                     const GradientOptions& options);
std::vector<double> base_and_detail_heights(const Surface& surface, const HeightSystem& system,
                                            const DetailOptions& options);
std::vector<double> equalised_heights(const Surface& surface, const EqualiseOptions& options);

}  // namespace relievo
