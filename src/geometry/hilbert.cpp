#include "geometry/hilbert.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace relievo {
namespace {

constexpr unsigned bits = 12;  // per axis; cells with many points are divided again

// The position on the curve in the upper 32 bits, the number of the point in the lower.
using Entry = std::uint64_t;
using Entries = std::span<Entry>;

constexpr Index number(Entry e) {
  return static_cast<Index>(e);
}
constexpr std::uint32_t place(Entry e) {
  return static_cast<std::uint32_t>(e >> 32);
}

// Returns how far along a Hilbert curve through 2^bits x 2^bits cells the cell (x, y) lies. At each level the
// curve visits four quadrants; the first and the last are mirrored at a diagonal.
std::uint32_t place_of_cell(std::uint32_t x, std::uint32_t y) {
  std::uint32_t place = 0;
  for (unsigned level = bits; level-- > 0;) {
    const std::uint32_t right = x >> level & 1, top = y >> level & 1;
    place = place << 2 | ((3 * right) ^ top);
    if (top == 0) {
      const std::uint32_t flip = right == 0 ? 0 : ~0U;
      const std::uint32_t old_x = x;
      x = y ^ flip;
      y = old_x ^ flip;
    }
  }
  return place;
}

// Sorts the entries along a curve through their bounding square. Returns false if all points coincide.
bool sort_along_curve(std::span<const Vec2> points, Entries entries) {
  Vec2 low = points[number(entries.front())], high = low;
  for (const Entry e : entries) {
    low = low.cwiseMin(points[number(e)]);
    high = high.cwiseMax(points[number(e)]);
  }
  const double extent = (high - low).maxCoeff();
  if (extent == 0) return false;
  const double scale = ((1U << bits) - 1) / extent;
  for (Entry& e : entries) {
    const Vec2 cell = (points[number(e)] - low) * scale;
    const auto x = static_cast<std::uint32_t>(cell.x()), y = static_cast<std::uint32_t>(cell.y());
    e = Entry{place_of_cell(x, y)} << 32 | number(e);
  }
  std::sort(entries.begin(), entries.end());
  return true;
}

}  // namespace

std::vector<Index> hilbert_order(std::span<const Vec2> points) {
  std::vector<Entry> entries(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) entries[i] = i;

  // Cells with more points than this are sorted along a curve of their own, until there are none. The stack
  // replaces recursion, which clusters within clusters could make deep.
  constexpr std::ptrdiff_t most_in_a_cell = 8;
  std::vector<Entries> todo;
  if (!entries.empty()) todo.emplace_back(entries);
  while (!todo.empty()) {
    const Entries part = todo.back();
    todo.pop_back();
    if (!sort_along_curve(points, part)) continue;
    for (auto begin = part.begin(); begin != part.end();) {
      const auto end = std::find_if(begin, part.end(), [&](Entry e) { return place(e) != place(*begin); });
      if (end - begin > most_in_a_cell) todo.emplace_back(begin, end);
      begin = end;
    }
  }

  std::vector<Index> order(points.size());
  std::transform(entries.begin(), entries.end(), order.begin(), number);
  return order;
}

}  // namespace relievo
