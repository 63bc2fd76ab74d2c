#include "twins.h"

#include <algorithm>
#include <cmath>

namespace relievo {
namespace {

// A used point as the files hold it.
struct Stored {
  std::array<float, 3> at;
  Index point;
  auto operator<=>(const Stored&) const = default;
};

}  // namespace

std::vector<std::array<Index, 2>> find_twins(const Solid& solid) {
  std::vector<bool> is_used(solid.points.size());
  for (const Triangle& t : solid.triangles)
    for (const Index i : t) is_used[i] = true;
  std::vector<Stored> stored;
  stored.reserve(solid.points.size());
  for (std::size_t i = 0; i < solid.points.size(); ++i) {
    if (!is_used[i]) continue;
    const Vec3f p = solid.points[i].cast<float>();
    stored.push_back({{p.x(), p.y(), p.z()}, static_cast<Index>(i)});
  }
  std::ranges::sort(stored);
  std::vector<std::array<Index, 2>> twins;
  for (std::size_t i = 1; i < stored.size(); ++i)
    if (stored[i].at == stored[i - 1].at) twins.push_back({stored[i - 1].point, stored[i].point});
  return twins;
}

void separate_twins(Solid& solid, double middle_z) {
  const int most_passes = 32;  // a pass may push a point onto a third one
  for (int pass = 0; pass < most_passes; ++pass) {
    const auto twins = find_twins(solid);
    if (twins.empty()) return;
    Index previous = no_index;
    int steps = 0;  // one more for each of several at the same place
    for (const auto& [first, second] : twins) {
      steps = first == previous ? steps + 1 : 1;
      auto z = static_cast<float>(solid.points[second].z());
      for (int i = 0; i < steps; ++i) z = std::nextafter(z, static_cast<float>(middle_z));
      solid.points[second].z() = static_cast<double>(z);
      previous = second;
    }
  }
}

}  // namespace relievo
