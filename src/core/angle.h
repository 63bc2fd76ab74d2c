// Converts between degrees, for options and reports, and radians, for computations.
#pragma once

#include <numbers>

namespace relievo {

constexpr double to_radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

constexpr double to_degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

}  // namespace relievo
