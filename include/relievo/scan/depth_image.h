// Defines depth images from a depth camera, a renderer or a depth estimator, and converts them into points.
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

// The depths in a file.
struct DepthImage {
  Image<float> values;  // NaN where there is no value
  double step = 0;      // step between possible values: 1 for integers, 0 for fractions
  std::string format;   // format of the file for messages, such as "PNG, 16 bits"
  // Width and height of a pixel, in metres for a terrain model; 0 if the file has no pixel size, and pixels
  // then count as square.
  Vec2 pixel_size = Vec2::Zero();

  // Returns the width and height of a pixel in units of the longer one.
  Vec2 pixel_shape() const {
    return pixel_size.x() > 0 ? Vec2(pixel_size / pixel_size.maxCoeff()) : Vec2(Vec2::Ones());
  }
};

// A pinhole camera; all numbers are in pixels.
struct DepthCamera {
  double fx = 0, fy = 0, cx = 0, cy = 0;

  bool operator==(const DepthCamera&) const = default;
};

// The meaning of a depth image's values.
enum class DepthValues {
  depth,      // increases away from the viewer; 0 is missing
  height,     // increases towards the viewer
  luminance,  // brightness (the luminance of colours), increases towards the viewer
  inverse,    // proportional to one over the depth, as depth estimators give it; 0 is infinitely far
  automatic   // to be determined by the program that reads the file; depth_cloud() treats it as `depth`
};

inline constexpr std::array<Choice<DepthValues>, 5> depth_value_choices{
    {{"depth", DepthValues::depth},
     {"height", DepthValues::height},
     {"inverse", DepthValues::inverse},
     {"luminance", DepthValues::luminance},
     {"auto", DepthValues::automatic}}};

// Whether a part of a depth image that is often unwanted (background or blur) is kept or dropped. With
// `automatic`, the kind of image determines whether the part is kept.
enum class Removal { keep, drop, automatic };

inline constexpr std::array<Choice<Removal>, 3> removal_choices{
    {{"auto", Removal::automatic}, {"keep", Removal::keep}, {"drop", Removal::drop}}};

struct DepthOptions {
  DepthValues values = DepthValues::depth;
  int channel = 0;  // number of the channel to read, from 1; 0 for the only channel
  std::optional<DepthCamera> camera;
  // Without a camera: the depth from the nearest to the farthest point, as a share of the picture's longer
  // side.
  double range = .5;
  // The background lies behind a depth jump all around the figure. `automatic` keeps the background of images
  // with a camera and of images of heights. If there is no such jump, `drop` removes far depths, provided
  // that they cover most of the image's border.
  Removal background = Removal::automatic;
  // Blur is a run of points between two surfaces that belong to neither surface. `drop` removes runs of at
  // most 12 points. `automatic` does the same in images of depth cameras. It keeps all points of height
  // images, because their walls are part of the surface. In other images it removes runs of up to 3 points.
  Removal blur = Removal::automatic;
  double points = 3e5;  // the image is reduced to about this many points

  bool operator==(const DepthOptions&) const = default;
};

// Returns an error of kind option, naming the option, if an option is out of range.
Result<void> check(const DepthOptions& options);

// Whether a pixel of a depth image is a point of the surface, has no depth, or was removed as background or
// blur.
enum class PixelUse : std::uint8_t { kept, missing, background, blur };

// The points of a depth image, and facts about the conversion.
struct DepthCloud {
  Cloud cloud;                 // seen from +Z, +Y up, in pixels; all normals face the viewer
  int reduction = 1;           // each point represents reduction x reduction pixels
  std::size_t missing = 0;     // number of pixels without a depth
  std::size_t marked = 0;      // number of pixels whose value, such as 1e10, marks a missing depth
  double marker = 0;           // the value that marks a missing depth; the largest if there are several
  std::size_t background = 0;  // number of points removed with the background
  std::size_t blur = 0;        // number of points removed as blur
  double noise = 0;            // median uncertainty of a depth, in pixels
  // One value per block of reduction x reduction pixels. The points of `cloud` are the kept pixels, in the
  // order of `uses`. For a picture from picture_cloud(), missing pixels are points, too.
  Image<PixelUse> uses;
};

// Returns the image as points. x and y are in pixels; if pixels are not square, the unit is their longer
// side. With a camera, z is -f log(depth), where f is the focal length in pixels, so that surfaces facing the
// camera stay flat and no point hides another. Without a camera, values are treated as depths along parallel
// rays.
//
// Rounding steps and noise are removed: the result is the smoothest surface whose depths are within intervals
// given by the step of the values and the measured noise. Depth jumps are not smoothed. Missing values are
// found first, then background and blur; the range of depths is that of the remaining values. Errors: those
// of check(); kind geometry if fewer than 16 pixels have a depth; kind cancelled.
Result<DepthCloud> depth_cloud(const DepthImage& image, const DepthOptions& options,
                               Progress* progress = nullptr);

// Returns a picture as flat points with grey colours for a lithophane: one point per pixel or block of
// pixels, and black points along the outline of the picture. The brightest value is white, the darkest black;
// missing values are white. Uses only options.points. Errors: those of check(); kind geometry if all values
// are equal.
Result<DepthCloud> picture_cloud(const DepthImage& image, const DepthOptions& options);

}  // namespace relievo
