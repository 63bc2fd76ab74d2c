// Baselines: other people's methods, to compare with. Each follows its paper and runs on the same visible points,
// normals and height system as layered reliefs, with the parameters that served it best on our scans (docs/quality.md).
#pragma once

#include "relievo/relief/gradient_slopes.h"
#include "relievo/relief/method.h"

namespace relievo {

struct Surface;

// The depths themselves, scaled.
Relief linear_relief(const Surface& surface, double height);

// Adaptive histogram equalisation of the depths: local histograms on a picture of the depths, weighted by
// gradients, clipped, for several sizes of neighbourhood, whose results are averaged. After Sun, Rosin,
// Martin and Langbein, Bas-relief generation using adaptive histogram equalization, 2009.
struct EqualiseOptions {
  int picture_px = 512;         // longer side of the picture, [16, 4096]
  int largest_window_px = 128;  // of the neighbourhoods; each next is half as wide, at most picture_px
  int windows = 2;              // number of sizes, >= 1
  int bins = 256;               // of a histogram, over all depths
  double clip = 12;             // most that a bin may contain, in means of the bins; the excess is spread
  double gradient_gain = 5;     // a in log(1 + a |g|) / a, the weight of a pixel with gradient g
};
Relief equalised_relief(const Surface& surface, double height, const EqualiseOptions& options = {});

// Gradient-domain compression: gradient_slopes() integrated with the background at the base.
Relief gradient_relief(const ReliefModel& model, double height, const GradientOptions& options);

// A linearly compressed base with amplified detail, which is the difference between the heights that the normals
// give and a Gaussian blur of them in the view plane. After Ji, Sun, Li and Wang, Real-time bas-relief generation
// from depth-and-normal maps on GPU, 2014.
struct DetailOptions {
  double amplification = 10;  // of the detail, against the base
  double scale = .08;         // the Gaussian's standard deviation, of the surface's longer side
};
Relief base_and_detail_relief(const ReliefModel& model, double height, const DetailOptions& options);

}  // namespace relievo
