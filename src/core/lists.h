// Removes elements of lists, or picks elements by their indices. Tested by tests/io/io_test.cpp and
// tests/scan/surface_test.cpp.
#pragma once

#include <cstddef>
#include <ranges>
#include <span>
#include <vector>

#include "relievo/core/parallel.h"
#include "relievo/core/types.h"

namespace relievo {

// Keeps the elements values[i] for which is_kept(i) is true, in their order. Calls is_kept() once for each i,
// in ascending order.
template <typename T, typename IsKept>
void keep_where(std::vector<T>& values, IsKept&& is_kept) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (is_kept(i)) values[kept++] = values[i];
  values.resize(kept);
}

// Returns the elements of `from` with the indices in `order`, in that order; an empty list if `from` is
// empty.
template <typename List>
auto pick(const List& from, std::span<const Index> order) {
  std::vector<std::ranges::range_value_t<List>> out(from.empty() ? 0 : order.size());
  parallel_for(out.size(), [&](std::size_t i) { out[i] = from[order[i]]; });
  return out;
}

}  // namespace relievo
