#include "plate/coincident_points.h"

#include <algorithm>
#include <cmath>

#include "geometry/weld.h"

namespace relievo {
namespace {

// A used point with its coordinates rounded as in a file.
struct Stored {
  std::array<float, 3> at;
  Index point;
  auto operator<=>(const Stored&) const = default;
};

}  // namespace

std::vector<Vec3f> stored_points(const Solid& solid) {
  std::vector<Vec3f> stored;
  stored.reserve(solid.points.size());
  for (const Vec3& p : solid.points) stored.push_back(p.cast<float>());
  return stored;
}

std::vector<std::array<Index, 2>> find_coincident_points(const Solid& solid) {
  const std::vector<std::uint8_t> is_used = used_points(solid.points.size(), solid.triangles);
  std::vector<Stored> stored;
  stored.reserve(solid.points.size());
  for (std::size_t i = 0; i < solid.points.size(); ++i) {
    if (!is_used[i]) continue;
    const Vec3f p = solid.points[i].cast<float>();
    stored.push_back({{p.x(), p.y(), p.z()}, static_cast<Index>(i)});
  }
  std::ranges::sort(stored);
  std::vector<std::array<Index, 2>> pairs;
  for (std::size_t i = 1; i < stored.size(); ++i)
    if (stored[i].at == stored[i - 1].at) pairs.push_back({stored[i - 1].point, stored[i].point});
  return pairs;
}

void separate_coincident(Solid& solid, double middle_z) {
  const int most_passes = 32;  // a moved point may coincide with a third point, so passes are repeated
  for (int pass = 0; pass < most_passes; ++pass) {
    const auto pairs = find_coincident_points(solid);
    if (pairs.empty()) return;
    Index previous = no_index;
    int steps = 0;  // the n-th of several coincident points moves by n steps
    for (const auto& [first, second] : pairs) {
      steps = first == previous ? steps + 1 : 1;
      auto z = static_cast<float>(solid.points[second].z());
      for (int i = 0; i < steps; ++i) z = std::nextafter(z, static_cast<float>(middle_z));
      solid.points[second].z() = static_cast<double>(z);
      previous = second;
    }
  }
}

}  // namespace relievo
