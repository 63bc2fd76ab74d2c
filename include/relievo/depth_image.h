// Depth images: what a depth camera, a renderer or a depth estimator gives, as points for the pipeline.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "relievo/core/progress.h"
#include "relievo/options.h"
#include "relievo/scan/cloud.h"

namespace relievo {

// Values as the file has them, row-major, first row at the top; NaN where it has none.
struct DepthImage {
  int width = 0, height = 0;
  std::vector<float> values;
  double step = 0;     // 1 for whole numbers, 0 for fractions
  std::string format;  // for people: "PNG, 16 bits"
};

// True for the beginning of a PNG or TIFF file.
bool is_picture(std::span<const std::byte> bytes);

// Returns the depths in a PNG (grey, 8 or 16 bits; colour if all channels are equal) or TIFF (one channel, 8
// or 16 bits or float32, strips or tiles, any compression that libtiff knows). Errors: kind input for other
// pictures, broken ones, more than 2^27 pixels or fewer than 4 x 4.
Result<DepthImage> read_depth_image(std::span<const std::byte> bytes, std::string_view name);

// A pinhole camera, in pixels.
struct DepthCamera {
  double fx = 0, fy = 0, cx = 0, cy = 0;
};

// Returns the camera of "FX,FY,CX,CY", or of nine numbers, its matrix row by row, separated by commas or
// white space. Errors: kind option for any other text, or a focal length that is not positive.
Result<DepthCamera> parse_camera(std::string_view text);

struct DepthOptions {
  // What the values are: "depth" grows away from the viewer, 0 is missing; "height" grows towards the viewer;
  // "inverse" is one over the depth, up to a factor, as estimators give it, and 0 is infinitely far.
  std::string values = "depth";
  std::optional<DepthCamera> camera;
  double range = .5;  // without a camera: depth from the nearest to the farthest, in picture widths
  // "keep"; "remove" what lies behind the largest gap in depth, if that is most of the border; "auto" is
  // remove without a camera and keep with one.
  std::string background = "auto";
  double points = 3e5;  // the image is reduced until about as many are left
};

// Calls f(field, value) for the options that have a flag, as visit() of ReliefOptions does.
template <typename Options, typename F>
requires std::is_same_v<std::remove_const_t<Options>, DepthOptions>
void visit(Options& o, F&& f) {
  f(OptionField{"depth-values", "KIND",
                "of a depth image: depth (0 is missing), height, or inverse depth as estimators give it"},
    o.values);
  f(OptionField{"depth-range", "R", "of a depth image without camera: nearest to farthest, in picture widths",
                .01, 10},
    o.range);
  f(OptionField{"background", "B", "of a depth image: keep, remove or auto (remove if there is no camera)"},
    o.background);
}

// Checks ranges and words. Errors: kind option, naming the option.
Result<void> check(const DepthOptions& options);

// What was done to a depth image.
struct DepthCloud {
  Cloud cloud;                 // seen from +Z, +Y up, in pixels, all normals towards the viewer
  int reduction = 1;           // pixels of the image per point, along one side
  std::size_t missing = 0;     // of its pixels, those without a depth
  std::size_t cut = 0;         // of the points, those on ramps between two surfaces, which are none
  std::size_t background = 0;  // those taken out
  double noise = 0;            // median of what a depth may be off, in pixels
};

// Returns the picture that the camera saw as points: x and y are its pixels, z is minus the logarithm of the
// depth times the focal length, so that what faces the camera is flat and nothing hides anything; without a
// camera depths are those of parallel rays. Steps of rounding and noise are smoothed away: the smoothest
// surface is taken whose depths all lie within what the value's step and the noise, measured in the image,
// leave open. It bends but does not cross depth jumps. Pixels on ramps between two surfaces are cut. Holes
// inside become points with a flat normal. Errors: those of check(); kind geometry if fewer than 16 pixels
// have a depth; kind cancelled.
Result<DepthCloud> depth_cloud(const DepthImage& image, const DepthOptions& options,
                               Progress* progress = nullptr);

}  // namespace relievo
