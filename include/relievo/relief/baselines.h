// Other people's methods, to compare with: each after its paper, on the same visible points, normals and
// height system as ours, and with the parameters that served it best on our scans (docs/quality.md).
#pragma once

#include "relievo/relief.h"
#include "relievo/relief/gradient_slopes.h"

namespace relievo {

// All return reliefs of exactly the height asked for, > 0, whose boundary points lie on the base; flat ones
// where the surface gives them nothing to scale. `shape` of the relief is of no meaning.

// The depths themselves, scaled.
Relief linear_relief(const Surface& surface, double height);

// Adaptive histogram equalisation of the depths: local histograms on a picture of the depths, weighted by
// gradients, clipped, for several sizes of neighbourhood, whose results are averaged. After Sun, Rosin,
// Martin and Langbein, Bas-relief generation using adaptive histogram equalization, 2009.
struct EqualiseOptions {
  int picture_px = 512;         // longer side of the picture, [16, 4096]
  int largest_window_px = 128;  // of the neighbourhoods; each next is half as wide, at most picture_px
  int windows = 2;              // how many, >= 1
  int bins = 256;               // of a histogram, over all depths
  double clip = 12;             // most that a bin may hold, in means of the bins; what is above is spread
  double gradient_gain = 5;     // a in log(1 + a |g|) / a, what a pixel with gradient g weighs
};
Relief equalised_relief(const Surface& surface, double height, const EqualiseOptions& options = {});

// Gradient-domain compression: gradient_slopes() integrated with the background held at the base.
Relief gradient_relief(const ReliefModel& model, double height, const GradientOptions& options = {});

// A linearly compressed base with the detail amplified: what a Gaussian in the view plane takes from the
// heights that the normals give. After Ji, Sun, Li and Wang, Real-time bas-relief generation from
// depth-and-normal maps on GPU, 2014.
struct DetailOptions {
  double amplification = 10;  // of the detail, against the base
  double scale = .08;         // the Gaussian's standard deviation, of the surface's longer side
};
Relief base_and_detail_relief(const ReliefModel& model, double height, const DetailOptions& options = {});

}  // namespace relievo
