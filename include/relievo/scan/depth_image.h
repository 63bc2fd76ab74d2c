// Depth images from a depth camera, a renderer or a depth estimator, and their conversion into points.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "relievo/core/choice.h"
#include "relievo/core/image.h"
#include "relievo/core/progress.h"
#include "relievo/core/types.h"
#include "relievo/scan/cloud.h"

namespace relievo {

// The depths stored in a file.
struct DepthImage {
  Image<float> values;  // NaN where there is no value
  double step = 0;      // difference between possible values: 1 for whole numbers, 0 for fractions
  std::string format;   // format of the file, for people: "PNG, 16 bits"
  // Width and height of a pixel, in metres for a terrain model; 0 if the file does not state them. Pixels are
  // then square.
  Vec2 pixel_size = Vec2::Zero();

  // Returns the width and height of a pixel in units of the longer of both.
  Vec2 pixel_shape() const {
    return pixel_size.x() > 0 ? Vec2(pixel_size / pixel_size.maxCoeff()) : Vec2(Vec2::Ones());
  }
};

// A pinhole camera, in pixels.
struct DepthCamera {
  double fx = 0, fy = 0, cx = 0, cy = 0;

  bool operator==(const DepthCamera&) const = default;
};

// The meaning of a depth image's values.
enum class DepthValues {
  depth,      // grows away from the viewer, 0 is missing
  height,     // grows towards the viewer
  luminance,  // brightness (the luminance of colours); brighter is nearer
  inverse,    // one over the depth, up to a factor, as estimators give it; 0 is infinitely far
  automatic   // to be found out by who reads the file; depth_cloud() takes it as `depth`
};

inline constexpr std::array<Choice<DepthValues>, 5> depth_value_choices{
    {{"depth", DepthValues::depth},
     {"height", DepthValues::height},
     {"inverse", DepthValues::inverse},
     {"luminance", DepthValues::luminance},
     {"auto", DepthValues::automatic}}};

// States whether a part of a depth image that is often not wanted, background or blur, is kept or dropped.
// `automatic` decides by the image.
enum class Removal { keep, drop, automatic };

inline constexpr std::array<Choice<Removal>, 3> removal_choices{
    {{"auto", Removal::automatic}, {"keep", Removal::keep}, {"drop", Removal::drop}}};

struct DepthOptions {
  DepthValues values = DepthValues::depth;
  int channel = 0;  // number of the channel to read, from 1; 0: the only one
  std::optional<DepthCamera> camera;
  double range = .5;  // without a camera: depth from the nearest to the farthest, in picture widths
  // The background lies behind a depth jump all around the figure. `automatic` keeps it with a camera
  // and in heights. `drop` without such a jump takes the far depths, if these are most of the border.
  Removal background = Removal::automatic;
  // Blur consists of points between two levels that continue neither. `automatic` keeps them in heights,
  // whose walls are surface, and in other images finds them over at most 3 points; `drop`, and
  // `automatic` in images of depth cameras, over at most 12.
  Removal blur = Removal::automatic;
  double points = 3e5;  // the image is reduced to about this number of points

  bool operator==(const DepthOptions&) const = default;
};

// Checks that the options are in their ranges. Errors: kind option, naming the option.
Result<void> check(const DepthOptions& options);

// Says whether a pixel of a depth image is a point of the surface, has no depth, or is removed with background
// or blur.
enum class PixelUse : std::uint8_t { kept, missing, background, blur };

// The points of a depth image, and facts about the conversion.
struct DepthCloud {
  Cloud cloud;                 // seen from +Z, +Y up, in pixels; all normals face the viewer
  int reduction = 1;           // each point represents reduction x reduction pixels
  std::size_t missing = 0;     // number of pixels without a depth
  std::size_t marked = 0;      // number of these with a value that stands for a missing depth, such as 1e10
  double marker = 0;           // that value; the largest, if there are several
  std::size_t background = 0;  // number of points removed with the background
  std::size_t blur = 0;        // number of points removed because they lie between two levels
  double noise = 0;            // median uncertainty of a depth, in pixels
  // One value for each reduction x reduction pixels. The kept ones are the points, in this order; a picture
  // of picture_cloud() has points for missing ones, too.
  Image<PixelUse> uses;
};

// Returns the image as points. x and y are pixels; if pixels are not square, their longer side is the unit. With
// a camera, z is -f log(depth), f the focal length in pixels: surfaces that face the camera stay flat, and no point hides another. Without a camera the values
// are taken as depths along parallel rays.
//
// Rounding steps and noise are removed: of all surfaces whose depths lie within the intervals given by the
// step of the values and the noise measured in the image, the smoothest is returned. It is not smoothed
// across depth jumps. Missing values are found first, then the background and blur; the range of depths is
// measured on what is left. Errors: those of check(); kind geometry if fewer than 16 pixels have a depth; kind
// cancelled.
Result<DepthCloud> depth_cloud(const DepthImage& image, const DepthOptions& options,
                               Progress* progress = nullptr);

// Returns a picture as flat points with grey colours, one for each pixel or block of pixels, for a lithophane:
// the brightest value is white, the darkest black, and missing values are white. Only `points` counts of the
// options. Errors: those of check(); kind geometry if all values are equal.
Result<DepthCloud> picture_cloud(const DepthImage& image, const DepthOptions& options);

}  // namespace relievo
