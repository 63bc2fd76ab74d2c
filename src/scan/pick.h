// Picks elements of a contiguous list by their numbers. Tested by tests/scan/surface_test.cpp.
#pragma once

#include <ranges>
#include <span>
#include <vector>

#include "relievo/core/parallel.h"
#include "relievo/core/types.h"

namespace relievo {

// Returns the elements that `order` numbers; an empty list if `from` is empty.
template <typename List>
auto pick(const List& from, std::span<const Index> order) {
  std::vector<std::ranges::range_value_t<List>> out(from.empty() ? 0 : order.size());
  parallel_for(out.size(), [&](std::size_t i) { out[i] = from[order[i]]; });
  return out;
}

}  // namespace relievo
