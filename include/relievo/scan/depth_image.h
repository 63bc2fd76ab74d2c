// Depth images from a depth camera, a renderer or a depth estimator, and their conversion into points.
#pragma once

#include <array>
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
};

// The meaning of a depth image's values.
enum class DepthValues {
  depth,      // grows away from the viewer, 0 is missing
  height,     // grows towards the viewer
  luminance,  // brightness (the luminance of colours); brighter is nearer
  inverse     // one over the depth, up to a factor, as estimators give it; 0 is infinitely far
};

inline constexpr std::array<Choice<DepthValues>, 4> depth_value_choices{
    {{"depth", DepthValues::depth},
     {"height", DepthValues::height},
     {"inverse", DepthValues::inverse},
     {"luminance", DepthValues::luminance}}};

enum class Background {
  keep,
  remove,    // removes the depths behind the largest gap, if these are most of the border
  automatic  // `remove` without a camera, `keep` with one
};

inline constexpr std::array<Choice<Background>, 3> background_choices{
    {{"keep", Background::keep}, {"remove", Background::remove}, {"auto", Background::automatic}}};

struct DepthOptions {
  DepthValues values = DepthValues::depth;
  int channel = 0;  // number of the channel to read, from 1; 0: the only one
  std::optional<DepthCamera> camera;
  double range = .5;  // without a camera: depth from the nearest to the farthest, in picture widths
  Background background = Background::automatic;
  double points = 3e5;  // the image is reduced to about this number of points
};

// Checks that the options are in their ranges. Errors: kind option, naming the option.
Result<void> check(const DepthOptions& options);

// The points of a depth image, and facts about the conversion.
struct DepthCloud {
  Cloud cloud;                 // seen from +Z, +Y up, in pixels; all normals face the viewer
  int reduction = 1;           // each point represents reduction x reduction pixels
  std::size_t missing = 0;     // number of pixels without a depth
  std::size_t cut = 0;         // number of points removed from ramps between two surfaces
  std::size_t background = 0;  // number of points removed with the background
  double noise = 0;            // median uncertainty of a depth, in pixels
};

// Returns the image as points. x and y are pixels; if pixels are not square, their longer side is the unit. With
// a camera, z is -f log(depth), f the focal length in pixels: surfaces that face the camera stay flat, and no point hides another. Without a camera the values
// are taken as depths along parallel rays.
//
// Rounding steps and noise are removed: of all surfaces whose depths lie within the intervals given by the
// step of the values and the noise measured in the image, the smoothest is returned. It is not smoothed
// across depth jumps. Pixels on ramps between two surfaces, which blurred outlines cause, are removed.
// Enclosed holes are filled with points whose normal is (0, 0, 1). Errors: those of check(); kind geometry if
// fewer than 16 pixels have a depth; kind cancelled.
Result<DepthCloud> depth_cloud(const DepthImage& image, const DepthOptions& options,
                               Progress* progress = nullptr);

// Returns a picture as flat points with grey colours, one for each pixel or block of pixels, for a lithophane:
// the brightest value is white, the darkest black, and missing values are white. Only `points` counts of the
// options. Errors: those of check(); kind geometry if all values are equal.
Result<DepthCloud> picture_cloud(const DepthImage& image, const DepthOptions& options);

}  // namespace relievo
