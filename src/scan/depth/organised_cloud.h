// Smooths organised clouds of depth cameras, whose points are the pixels of a picture.
#pragma once

#include <cstddef>
#include <optional>

#include "relievo/scan/cloud.h"

namespace relievo {

// The points that a camera at the origin has measured, one per pixel of its picture, row by row. The point of a pixel
// without a depth is not finite, or lies at the origin.
struct OrganisedCloud {
  Cloud cloud;
  std::size_t columns = 0;
  bool keeps_blur = false;
};

// The result of smooth_organised(), for remarks to the user.
struct OrganisedSmoothing {
  double noise = 0;      // median uncertainty of a depth, in pixels
  std::size_t blur = 0;  // number of points that were blur between two surfaces; they are NaN now
};

// Smooths an organised cloud as depth_cloud() smooths a depth image: its points move along their rays, and get
// normals that face the camera. The cloud must have at least 4 x 4 pixels and no normals, and its points must lie on
// the rays of a pinhole camera at the origin, in any direction. Otherwise returns nothing and leaves the cloud as it
// is.
std::optional<OrganisedSmoothing> smooth_organised(OrganisedCloud& scan);

}  // namespace relievo
