// The triangles around each point of a mesh that changes in a few places. Tested by
// tests/plate/thin_triangles_test.cpp.
#pragma once

#include <algorithm>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/groups.h"
#include "relievo/core/types.h"

namespace relievo {

class Fans {
 public:
  // Refers to the triangles, which must stay at their address.
  Fans(std::size_t points, std::span<const Triangle> triangles)
      : triangles_(triangles), first_(grouped<Index>(points, [&](auto&& add) {
          for (Index t = 0; t < triangles.size(); ++t)
            for (const Index i : triangles[t]) add(i, t);
        })) {}

  // Returns the triangles around a point; the span is valid until the mesh is changed.
  std::span<const Index> around(Index point) const {
    const auto found = changed_.find(point);
    return found == changed_.end() ? first_[point] : std::span<const Index>(found->second);
  }

  // Returns the triangle to the left of the edge; no_index if there is none.
  Index left_of(Index from, Index to) const {
    for (const Index t : around(from)) {
      const auto& [a, b, c] = triangles_[t];
      if ((a == from && b == to) || (b == from && c == to) || (c == from && a == to)) return t;
    }
    return no_index;
  }

  void add(Index point, Index triangle) { changing(point).push_back(triangle); }
  void remove(Index point, Index triangle) { std::erase(changing(point), triangle); }

 private:
  std::vector<Index>& changing(Index point) {
    const auto [found, is_new] = changed_.try_emplace(point);
    if (is_new) found->second.assign(first_[point].begin(), first_[point].end());
    return found->second;
  }

  std::span<const Triangle> triangles_;
  Groups<Index> first_;
  std::unordered_map<Index, std::vector<Index>> changed_;
};

}  // namespace relievo
