// Rows of sparse matrices over the points of a triangulation, made in parallel.
#pragma once

#include <numeric>
#include <vector>

#include "core/groups.h"
#include "relievo/core/parallel.h"
#include "relievo/geometry/triangulation.h"
#include "relievo/scan/boundary.h"

namespace relievo {

// Returns for each point its corners in triangles inside, ascending; corner i of triangle t has the number 3
// t + i.
inline Groups<Index> corners_inside(std::size_t points, const std::vector<Triangle>& triangles,
                                    const Boundary& boundary) {
  return grouped<Index>(points, [&](auto&& add) {
    for (Index t = 0; t < triangles.size(); ++t)
      for (Index i = 0; i < 3 && boundary.is_inside[t]; ++i) add(triangles[t][i], 3 * t + i);
  });
}

// Returns the entries of each row. make(first, end, row) calls row(i, add) for each i of [first, end) in
// ascending order, and add(entries) appends the entries of that row.
template <typename Entry, typename Make>
Groups<Entry> rows_in_order(std::size_t rows, Make&& make) {
  Groups<Entry> all{std::vector<Index>(rows + 1), {}};
  std::vector<std::vector<Entry>> parts((rows + default_grain - 1) / default_grain);
  parallel_ranges(rows, default_grain, [&](std::size_t first, std::size_t end) {
    std::vector<Entry>& part = parts[first / default_grain];
    part.reserve(8 * (end - first));
    make(first, end, [&](std::size_t i, auto&& add) {
      const std::size_t before = part.size();
      add(part);
      all.begin[i + 1] = static_cast<Index>(part.size() - before);
    });
  });
  std::partial_sum(all.begin.begin(), all.begin.end(), all.begin.begin());
  all.items.reserve(all.begin.back());
  for (std::vector<Entry>& part : parts) {
    all.items.insert(all.items.end(), part.begin(), part.end());
    part = {};
  }
  return all;
}

}  // namespace relievo
