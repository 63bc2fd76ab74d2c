// Baselines: published methods of other authors, for comparison. Each follows its paper and runs on the same
// visible points, normals and height system as layered reliefs, with the parameters that served it best on
// our scans (docs/quality.md).
#pragma once

#include "relievo/relief/gradient_slopes.h"
#include "relievo/relief/method.h"

namespace relievo {

struct Surface;

// Returns the depths themselves, scaled to the height.
Relief linear_relief(const Surface& surface, double height);

// Adaptive histogram equalisation of the depths. Local histograms on a picture of the depths are weighted by
// gradients and clipped; the results for several sizes of neighbourhood are averaged. After Sun, Rosin,
// Martin and Langbein, Bas-relief generation using adaptive histogram equalization, 2009.
struct EqualiseOptions {
  int picture_px = 512;         // longer side of the picture, [16, 4096]
  int largest_window_px = 128;  // the largest neighbourhood, at most picture_px; each next is half as wide
  int windows = 2;              // number of sizes, >= 1
  int bins = 256;               // number of bins of a histogram, over all depths
  double clip = 12;             // limit of a bin, in units of the mean bin; the excess is spread over all
  double gradient_gain = 5;     // a in log(1 + a |g|) / a, the weight of a pixel with gradient g
};
Relief equalised_relief(const Surface& surface, double height, const EqualiseOptions& options = {});

// Gradient-domain compression: gradient_slopes() integrated with the background at the base.
Relief gradient_relief(const ReliefModel& model, double height, const GradientOptions& options);

// A linearly compressed base with amplified detail, which is the difference between the heights that the
// normals give and a Gaussian blur of them in the view plane. After Ji, Sun, Li and Wang, Real-time
// bas-relief generation from depth-and-normal maps on GPU, 2014.
struct DetailOptions {
  double amplification = 10;  // factor of the detail relative to the base
  double scale = .08;         // the Gaussian's standard deviation, as a share of the surface's longer side
};
Relief base_and_detail_relief(const ReliefModel& model, double height, const DetailOptions& options);

}  // namespace relievo
