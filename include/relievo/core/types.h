// Defines the basic types of all other headers.
#pragma once

#include <Eigen/Core>
#include <algorithm>
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

// The index of a point, vertex or triangle. No stage accepts more than 2^32 - 2 of them.
using Index = std::uint32_t;
inline constexpr Index no_index = ~Index{0};

// Three vertices, counter-clockwise seen from +Z or, in a solid, seen from outside.
using Triangle = std::array<Index, 3>;

// The unit of coordinates and lengths. core/length.h parses and names it.
enum class LengthUnit { mm, inch };

// Red, green, blue.
using Colour = std::array<std::uint8_t, 3>;

// Returns the rounded mixture of two colours: a for `share` = 0, b for `share` = 1.
inline Colour mixed(const Colour& a, const Colour& b, double share) {
  Colour out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = static_cast<std::uint8_t>(a[i] + share * (b[i] - a[i]) + .5);
  return out;
}

// An axis-aligned box. Until the first extend() it is empty, with min above max. An empty box has size 0 and
// its centre at the origin.
struct Box {
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());

  void extend(const Vec3& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  // Returns the bounding box of 2D or 3D points of any precision. 2D points have z = 0.
  template <typename Points>
  static Box of(const Points& points) {
    Box box;
    for (const auto& p : points) {
      Vec3 corner = Vec3::Zero();
      corner.head<std::remove_cvref_t<decltype(p)>::RowsAtCompileTime>() = p.template cast<double>();
      box.extend(corner);
    }
    return box;
  }

  bool is_empty() const { return (min.array() > max.array()).any(); }
  Vec3 size() const { return is_empty() ? Vec3::Zero() : Vec3(max - min); }
  Vec3 centre() const { return is_empty() ? Vec3::Zero() : Vec3((min + max) / 2); }
  double diagonal() const { return size().norm(); }
  // Returns the longer of the box's extents in x and y.
  double longer_side() const { return std::max(size().x(), size().y()); }
};

}  // namespace relievo
