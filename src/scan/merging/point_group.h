// A group of points of a cloud that one point represents. Tested by tests/scan/subsample_test.cpp and
// tests/scan/repeated_points_test.cpp.
#pragma once

#include <array>

#include "relievo/scan/cloud.h"

namespace relievo {

struct PointGroup {
  Vec3f normal = Vec3f::Zero();  // sum of the normals
  std::array<std::uint32_t, 3> colour{};
  std::uint32_t members = 0;

  void add(const Cloud& cloud, std::size_t i) {
    if (cloud.has_normals()) normal += cloud.normals[i];
    ++members;
    if (!cloud.has_colours()) return;
    for (std::size_t k = 0; k < 3; ++k) colour[k] += cloud.colours[i][k];
  }
  Colour mean_colour() const {
    const auto mean = [&](std::size_t k) { return static_cast<std::uint8_t>(colour[k] / members); };
    return {mean(0), mean(1), mean(2)};
  }
};

}  // namespace relievo
