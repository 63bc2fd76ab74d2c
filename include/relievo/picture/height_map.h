// Files for other programs: 3MF, and height maps in millimetres as float TIFF.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "relievo/plate/solid.h"
#include "relievo/preview.h"

namespace relievo {

// Returns the solid as 3MF (core specification 1.3): one object, unit and coordinates those of the solid, in
// single precision. `metadata` becomes the model's metadata, keys being names that the specification knows
// (Title, Description, Designer, Copyright, Application ...). The same solid gives the same bytes: no dates.
// Empty if the file would exceed 4 GB. The solid's corners must exist, as check_solid() tells.
std::vector<std::byte> write_3mf(const Solid& solid,
                                 std::span<const std::pair<std::string, std::string>> metadata = {});

// Heights in millimetres above the lowest point of the front, row-major, first row at the top.
struct HeightsMm {
  Image<float> image;
  double mm_per_pixel = 0;
  std::string note = {};  // more to be said in a file's description
};

// Returns the front of a solid as heights, see make_height_map().
HeightsMm make_heights_mm(const Solid& solid, int longer_side_px);

// Returns the heights as a float32 TIFF, deflated; pixels per centimetre are in its resolution tags,
// mm_per_pixel and the unit of the heights in its description. No bytes for an image without pixels.
std::vector<std::byte> write_tiff(const HeightsMm& heights);

}  // namespace relievo
