// Rows of sparse matrices over the points of a triangulation, made in parallel.
#pragma once

#include <numeric>
#include <vector>

#include "core/groups.h"
#include "relievo/core/parallel.h"
#include "relievo/geometry/triangulation.h"
#include "relievo/scan/boundary.h"

namespace relievo {

// Returns per point its corners of triangles inside: 3 t + i for corner i of triangle t, in ascending order.
inline Groups<Index> corners_inside(std::size_t points, const std::vector<Triangle>& triangles,
                                    const Boundary& boundary) {
  return grouped<Index>(points, [&](auto&& add) {
    for (Index t = 0; t < triangles.size(); ++t)
      for (Index i = 0; i < 3 && boundary.is_inside[t]; ++i) add(triangles[t][i], 3 * t + i);
  });
}

// Returns the entries of all rows, row by row, and sets begin[i] to the first of row i; `begin` has one element more than
// there are rows. make(first, end, row) calls row(i, add) for each i of [first, end) in ascending order, and add(entries)
// appends the entries of that row.
template <typename Entry, typename Make>
std::vector<Entry> rows_in_order(std::vector<Index>& begin, Make&& make) {
  const std::size_t rows = begin.size() - 1;
  std::vector<std::vector<Entry>> parts((rows + default_grain - 1) / default_grain);
  begin[0] = 0;
  parallel_ranges(rows, default_grain, [&](std::size_t first, std::size_t end) {
    std::vector<Entry>& part = parts[first / default_grain];
    part.reserve(8 * (end - first));
    make(first, end, [&](std::size_t i, auto&& add) {
      const std::size_t before = part.size();
      add(part);
      begin[i + 1] = static_cast<Index>(part.size() - before);
    });
  });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Entry> entries;
  entries.reserve(begin.back());
  for (std::vector<Entry>& part : parts) {
    entries.insert(entries.end(), part.begin(), part.end());
    part = {};
  }
  return entries;
}

}  // namespace relievo
