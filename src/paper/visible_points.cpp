#include "paper/visible_points.h"

#include <cstdint>
#include <unordered_map>

namespace relievo::paper {

std::vector<Index> visible_points(const Cloud& viewed, double rho) {
  const double side = 2 * rho;
  const Vec3 corner = Box::of(viewed.points).min;
  const auto cell_of = [&](const Vec3& p) {
    const Vec3 place = (p - corner) / side;
    return static_cast<std::uint64_t>(place.x()) << 32 | static_cast<std::uint64_t>(place.y());
  };
  std::unordered_map<std::uint64_t, double> highest;
  for (const Vec3& p : viewed.points) {
    const auto [cell, is_new] = highest.try_emplace(cell_of(p), p.z());
    if (!is_new) cell->second = std::max(cell->second, p.z());
  }
  std::vector<Index> visible;
  for (Index i = 0; i < viewed.points.size(); ++i) {
    const Vec3& p = viewed.points[i];
    if (highest[cell_of(p)] - p.z() < side && viewed.normals[i].z() > 0) visible.push_back(i);
  }
  return visible;
}

}  // namespace relievo::paper
