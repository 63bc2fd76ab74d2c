// Elements of a list by their numbers. Tested by tests/scan/surface_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/parallel.h"
#include "relievo/core/types.h"

namespace relievo {

// Returns the elements numbered by `order`; nothing of an empty list.
template <typename T>
std::vector<T> pick(const std::vector<T>& from, std::span<const Index> order) {
  if (from.empty()) return {};
  std::vector<T> out(order.size());
  parallel_for(order.size(), [&](std::size_t i) { out[i] = from[order[i]]; });
  return out;
}

}  // namespace relievo
