// The small types every other header shares.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace relievo {

using Vec2 = Eigen::Vector2d;
using Vec2f = Eigen::Vector2f;
using Vec3 = Eigen::Vector3d;
using Vec3f = Eigen::Vector3f;
using Mat3 = Eigen::Matrix3d;

// Number of a point, vertex or triangle. No stage takes more than 2^32 - 2 of them.
using Index = std::uint32_t;
inline constexpr Index no_index = ~Index{0};

// Three vertices, counter-clockwise as seen from +Z (from outside, for a solid).
using Triangle = std::array<Index, 3>;

// Red, green, blue.
using Colour = std::array<std::uint8_t, 3>;

// An axis-aligned box. Empty until the first extend(): then min is above max.
struct Box {
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());

  void extend(const Vec3& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  bool is_empty() const { return (min.array() > max.array()).any(); }
  Vec3 size() const { return is_empty() ? Vec3::Zero() : Vec3(max - min); }
  Vec3 centre() const { return is_empty() ? Vec3::Zero() : Vec3((min + max) / 2); }
  double diagonal() const { return size().norm(); }
};

}  // namespace relievo
