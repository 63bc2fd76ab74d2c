#include "geometry/weld.h"

#include <utility>

namespace relievo {
namespace {

using detail::bits_of;

bool coincide(const Vec3& p, const Vec3& q) {
  return bits_of(p.x()) == bits_of(q.x()) && bits_of(p.y()) == bits_of(q.y()) &&
         bits_of(p.z()) == bits_of(q.z());
}

}  // namespace

PointTable::PointTable(std::size_t expected) {
  make_slots(std::bit_ceil(2 * expected + 16));
}

void PointTable::make_slots(std::size_t count) {
  slots_.assign(count, Slot{0, no_index});
  shift_ = 64 - std::countr_zero(count);
}

Index PointTable::find_or_add(const Vec3& point, std::uint64_t hash, const Vec3* points, Index next) {
  const auto check = static_cast<std::uint32_t>(hash);
  std::size_t at = hash >> shift_;
  for (; slots_[at].number != no_index; at = (at + 1) & (slots_.size() - 1))
    if (slots_[at].check == check && coincide(points[slots_[at].number], point)) return slots_[at].number;
  slots_[at] = {check, next};
  if (2 * ++used_ > slots_.size()) grow(points);
  return next;
}

void PointTable::grow(const Vec3* points) {
  const std::vector<Slot> former = std::exchange(slots_, {});
  make_slots(2 * former.size());
  for (const Slot& slot : former) {
    if (slot.number == no_index) continue;
    std::size_t at = hash_of(points[slot.number]) >> shift_;
    while (slots_[at].number != no_index) at = (at + 1) & (slots_.size() - 1);
    slots_[at] = slot;
  }
}

std::vector<Index> first_coincident(std::span<const Vec3> points) {
  PointTable table(points.size());
  std::vector<Index> first(points.size());
  for_each_hashed(
      table, points.size(), [&](std::size_t i) -> const Vec3& { return points[i]; },
      [&](std::size_t i, std::uint64_t hash) {
        first[i] = table.find_or_add(points[i], hash, points.data(), static_cast<Index>(i));
      });
  return first;
}

UsedPoints compact(std::size_t point_count, std::span<Triangle> triangles) {
  UsedPoints used{{}, std::vector<Index>(point_count, no_index)};
  for (const Triangle& t : triangles)
    for (const Index i : t) used.new_number[i] = 0;
  for (Index i = 0; i < point_count; ++i) {
    if (used.new_number[i] == no_index) continue;
    used.new_number[i] = static_cast<Index>(used.points.size());
    used.points.push_back(i);
  }
  for (Triangle& t : triangles)
    for (Index& i : t) i = used.new_number[i];
  return used;
}

std::vector<std::uint8_t> used_points(std::size_t point_count, std::span<const Triangle> triangles) {
  std::vector<std::uint8_t> is_used(point_count, 0);
  for (const Triangle& t : triangles)
    for (const Index i : t) is_used[i] = 1;
  return is_used;
}

Box used_box(std::span<const Vec3> points, std::span<const Triangle> triangles) {
  Box box;
  for (const Triangle& t : triangles)
    for (const Index i : t) box.extend(points[i]);
  return box;
}

}  // namespace relievo
