// Merges coincident points. Tested by tests/geometry/extent_test.cpp.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "core/lists.h"
#include "relievo/core/types.h"

namespace relievo {

namespace detail {
// Returns a coordinate's bits. Adding 0 turns -0 into 0, so that 0 and -0 have the same bits.
inline std::uint64_t bits_of(double coordinate) {
  return std::bit_cast<std::uint64_t>(coordinate + 0.0);
}
}  // namespace detail

// A hash table of the indices of distinct points. The caller stores the points. Points coincide if their
// coordinates have the same bits; 0 and -0 count as the same.
class PointTable {
 public:
  // `expected` is the expected number of distinct points; with more points the table grows.
  explicit PointTable(std::size_t expected);

  // Returns a hash in which each coordinate affects all high bits, which determine the slot in the table.
  static std::uint64_t hash_of(const Vec3& point) {
    constexpr std::uint64_t factor = 0x9E3779B97F4A7C15;  // 2^64 divided by the golden ratio
    std::uint64_t hash = 0;
    for (int c = 0; c < 3; ++c) {
      hash = (hash ^ detail::bits_of(point[c])) * factor;
      hash ^= hash >> 32;
    }
    return hash * factor;
  }

  // Prefetches the slot of a point with that hash. The table is larger than caches, so reads without
  // prefetching would mostly wait for memory.
  void prefetch(std::uint64_t hash) const { __builtin_prefetch(&slots_[hash >> shift_]); }

  // Returns the index of the point in the table that coincides with `point`. If there is none, adds `point`
  // with index `next` and returns `next`. points[i] must be the point with index i, also for `next`.
  Index find_or_add(const Vec3& point, std::uint64_t hash, const Vec3* points, Index next);

 private:
  struct Slot {
    // Some bits of the hash. Different points mostly have different bits, so their coordinates need not be read.
    std::uint32_t check;
    Index number;
  };

  void make_slots(std::size_t count);
  void grow(const Vec3* points);

  std::vector<Slot> slots_;
  int shift_ = 0;  // a hash is shifted right by this to give a slot of the table
  std::size_t used_ = 0;
};

// Calls resolve(i, hash) for each i in [0, n), in order; `hash` is the hash of point(i). Slots are prefetched
// several points ahead.
template <typename Point, typename Resolve>
void for_each_hashed(const PointTable& table, std::size_t n, const Point& point, const Resolve& resolve) {
  constexpr std::size_t ahead = 32;  // fastest of 8 to 64 for an STL file with 3 million corners
  std::uint64_t hashes[ahead];
  for (std::size_t i = 0; i < n + ahead; ++i) {
    if (i >= ahead) resolve(i - ahead, hashes[i % ahead]);
    if (i >= n) continue;
    hashes[i % ahead] = PointTable::hash_of(point(i));
    table.prefetch(hashes[i % ahead]);
  }
}

// Returns for each point the lowest index of a point with exactly the same coordinates.
std::vector<Index> first_coincident(std::span<const Vec3> points);

// The used points of a mesh and their new indices.
struct UsedPoints {
  std::vector<Index> points;      // old indices of the used points, ascending
  std::vector<Index> new_number;  // per old point: its position in `points`; no_index if it is unused

  // Returns the elements of the used points. `old` has an element per old point. If `old` is empty, so is the
  // result.
  template <typename T>
  std::vector<T> pick(const std::vector<T>& old) const {
    return relievo::pick(old, points);
  }
};

// Renumbers the corners of triangles over `point_count` points. Only used points get indices, in their old
// order.
UsedPoints compact(std::size_t point_count, std::span<Triangle> triangles);

// Removes the points that no triangle uses, and their colours.
template <typename AnyMesh>
UsedPoints drop_unused(AnyMesh& mesh) {
  UsedPoints used = compact(mesh.points.size(), mesh.triangles);
  mesh.points = used.pick(mesh.points);
  mesh.colours = used.pick(mesh.colours);
  return used;
}

// Returns, for each of `point_count` points, whether a triangle uses it.
std::vector<std::uint8_t> used_points(std::size_t point_count, std::span<const Triangle> triangles);

// Returns the bounding box of the points that triangles use.
Box used_box(std::span<const Vec3> points, std::span<const Triangle> triangles);

}  // namespace relievo
