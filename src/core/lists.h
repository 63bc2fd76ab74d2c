// Removes elements of lists, or finds and picks elements by their indices. Tested by tests/io/io_test.cpp
// and tests/scan/surface_test.cpp.
#pragma once

#include <cstddef>
#include <functional>
#include <numeric>
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

// Returns the numbers i in [0, n) for which is_wanted(i) is true, ascending.
template <typename IsWanted>
std::vector<Index> indices_where(std::size_t n, IsWanted&& is_wanted) {
  std::vector<Index> found;
  for (Index i = 0; i < n; ++i)
    if (is_wanted(i)) found.push_back(i);
  return found;
}

// Returns the number of indices i in [0, n) for which is_counted(i) is true. Calls is_counted() concurrently.
template <typename IsCounted>
std::size_t count_where(std::size_t n, const IsCounted& is_counted) {
  const auto count = [&](std::size_t begin, std::size_t end) {
    std::size_t found = 0;
    for (std::size_t i = begin; i < end; ++i) found += is_counted(i) ? 1 : 0;
    return found;
  };
  return parallel_reduce(n, std::size_t{0}, count, std::plus<>());
}

inline std::vector<Index> all_indices(std::size_t n) {
  std::vector<Index> all(n);
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

// Returns, for each number in [0, n), its position in `listed`, or no_index.
inline std::vector<Index> places_in(std::span<const Index> listed, std::size_t n) {
  std::vector<Index> place(n, no_index);
  for (Index i = 0; i < listed.size(); ++i) place[listed[i]] = i;
  return place;
}

template <typename T, typename List>
void append(std::vector<T>& to, const List& from) {
  to.insert(to.end(), from.begin(), from.end());
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
