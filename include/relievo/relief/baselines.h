// Makes reliefs by baselines: published methods of other authors that users can choose. Each follows its
// paper, and uses the same visible points, normals and height system as layered reliefs, with fixed
// parameters that suit our scans. baseline_grid.h compares these and other baselines at their best.
#pragma once

#include <vector>

#include "relievo/core/types.h"
#include "relievo/relief/method.h"

namespace relievo {

struct Surface;

// Gradient-domain compression. Source: Weyrich, Deng, Barnes, Rusinkiewicz and Finkelstein, Digital
// bas-relief from 3D scenes, 2007.
struct GradientOptions {
  double attenuation = 5;     // a in log(1 + a |g|) / a, > 0
  double steepest_kept = 10;  // gradients steeper than this are removed
  // Weights of the bands, from the finest. A band is the difference between two consecutive Gaussian blurs,
  // the second one twice as wide as the first; the last band is the remainder.
  std::vector<double> band_weights{1, 1, .8, .6};
  double finest_band = .01;  // the first Gaussian's standard deviation, as a share of the longer side
};

// Returns a slope per point. Gradients at silhouettes are removed, all others are attenuated (see
// attenuated()), and their frequency bands are weighted. The gradients are computed from the scan's normals.
// Gradients of a height map would be noisy and would have to be removed at depth jumps.
std::vector<Vec2> gradient_slopes(const Surface& surface, const GradientOptions& options = {});

// Returns the slope (dz/dx, dz/dy) of a surface with this normal, z > 0, limited to 1e3.
Vec2 slope_of(const Vec3f& normal);

// Returns the gradient g with its length reduced to log(1 + a |g|) / a.
Vec2 attenuated(const Vec2& gradient, double a);

// Returns the relief whose heights are the depths, scaled linearly to `height`.
Relief linear_relief(const Surface& surface, double height);

// Adaptive histogram equalisation of the depths. Local histograms of a depth image are weighted by gradients
// and clipped, and the results for several sizes of neighbourhoods are averaged. Source: Sun, Rosin, Martin
// and Langbein, Bas-relief generation using adaptive histogram equalization, 2009.
struct EqualiseOptions {
  int picture_px = 512;  // longer side of the picture, [16, 4096]
  // Width of the largest neighbourhood, at most picture_px. Each further neighbourhood is half as wide as the
  // previous one.
  int largest_window_px = 128;
  int windows = 2;   // number of neighbourhood sizes, >= 1
  int bins = 256;    // number of bins of a histogram over all depths
  double clip = 12;  // limit of a bin, in units of the mean bin; the excess is distributed over all bins
  double gradient_gain = 5;  // a in log(1 + a |g|) / a, the weight of a pixel with gradient g
};
Relief equalised_relief(const Surface& surface, double height, const EqualiseOptions& options = {});

// Returns the relief of that height whose slopes fit gradient_slopes() best. The background is on the base.
Relief gradient_relief(const ReliefModel& model, double height, const GradientOptions& options);

// A linearly compressed base with amplified detail. The detail is the difference between the heights from the
// normals and their Gaussian blur in the view plane. Source: Ji, Sun, Li and Wang, Real-time bas-relief
// generation from depth-and-normal maps on GPU, 2014.
struct DetailOptions {
  double amplification = 10;  // factor of the detail relative to the base
  double scale = .08;         // the Gaussian's standard deviation, as a share of the surface's longer side
};
Relief base_and_detail_relief(const ReliefModel& model, double height, const DetailOptions& options);

}  // namespace relievo
