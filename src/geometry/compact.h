// The points of a mesh that its triangles use.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// The used points of a mesh and their new numbers.
struct UsedPoints {
  std::vector<Index> points;      // the old numbers of the used points, ascending
  std::vector<Index> new_number;  // per old point its place in `points`, no_index if it is not used

  // Returns the elements of an array over the old points that belong to used ones; an empty array for an
  // empty one.
  template <typename T>
  std::vector<T> pick(const std::vector<T>& old) const {
    std::vector<T> picked;
    if (old.empty()) return picked;
    picked.reserve(points.size());
    for (const Index i : points) picked.push_back(old[i]);
    return picked;
  }
};

// Renumbers the corners of triangles over `point_count` points: only used points get numbers, in their old
// order.
UsedPoints compact(std::size_t point_count, std::span<Triangle> triangles);

// Removes the points of a mesh, and their colours, that no triangle uses.
template <typename AnyMesh>
UsedPoints drop_unused(AnyMesh& mesh) {
  UsedPoints used = compact(mesh.points.size(), mesh.triangles);
  mesh.points = used.pick(mesh.points);
  mesh.colours = used.pick(mesh.colours);
  return used;
}

// Returns for each of `point_count` points whether a triangle uses it.
std::vector<std::uint8_t> used_points(std::size_t point_count, std::span<const Triangle> triangles);

// Returns the box of the points that triangles use.
Box used_box(std::span<const Vec3> points, std::span<const Triangle> triangles);

}  // namespace relievo
