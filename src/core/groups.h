// Groups items by an index, such as the triangles around each point, and stores them in two arrays.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Compressed sparse rows: the items of group g are items[begin[g]] up to, but not including, items[begin[g +
// 1]]. `begin` has one element more than there are groups.
template <typename Item, typename Offset = Index>
struct Groups {
  std::vector<Offset> begin = {0};
  std::vector<Item> items;

  std::size_t size() const { return begin.size() - 1; }
  std::span<const Item> operator[](std::size_t group) const {
    return std::span(items).subspan(begin[group], begin[group + 1] - begin[group]);
  }
};

// Calls each_item(add), which calls add(group, item) for every item. Returns the items by group, 0 to
// `groups` - 1; the items of a group keep their order. each_item is called twice, to count and to fill, and
// must pass the same items both times.
template <typename Item, typename Offset = Index, typename EachItem>
Groups<Item, Offset> grouped(std::size_t groups, EachItem&& each_item) {
  Groups<Item, Offset> result;
  result.begin.assign(groups + 1, 0);
  each_item([&](std::size_t group, const Item&) { ++result.begin[group + 1]; });
  for (std::size_t g = 0; g < groups; ++g) result.begin[g + 1] += result.begin[g];
  result.items.resize(result.begin.back());
  std::vector<Offset> next(result.begin.begin(), result.begin.end() - 1);
  each_item([&](std::size_t group, const Item& item) { result.items[next[group]++] = item; });
  return result;
}

}  // namespace relievo
