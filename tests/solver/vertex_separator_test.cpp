#include "solver/dissection.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>

#include "support/shapes.h"

namespace relievo::solver {
namespace {

// Returns a random graph with random positions. The smallest separator must have the same size for any positions.
SeparatorBand random_band(Index n, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<std::vector<Index>> nearby(n);
  for (Index e = 0; e < 2 * n; ++e) {
    const auto a = static_cast<Index>(random.bits() % n), b = static_cast<Index>(random.bits() % n);
    if (a == b) continue;
    nearby[a].push_back(b);
    nearby[b].push_back(a);
  }
  SeparatorBand band{.direction = {1, 0}};
  for (auto& list : nearby) {
    band.graph.to.insert(band.graph.to.end(), list.begin(), list.end());
    band.graph.begin.push_back(static_cast<Index>(band.graph.to.size()));
    band.positions.emplace_back(static_cast<float>(random.uniform()), static_cast<float>(random.uniform()));
    band.touches_first.push_back(random.bits() % 4 == 0);
    band.touches_second.push_back(random.bits() % 4 == 0);
  }
  return band;
}

bool separates(const SeparatorBand& band, const std::vector<std::uint8_t>& is_removed) {
  std::vector<std::uint8_t> is_seen = is_removed;
  std::vector<Index> stack;
  const auto reach = [&](Index v) {
    if (!is_seen[v]) is_seen[v] = 1, stack.push_back(v);
  };
  for (Index v = 0; v < band.graph.size(); ++v)
    if (band.touches_first[v]) reach(v);
  while (!stack.empty()) {
    const Index v = stack.back();
    stack.pop_back();
    if (band.touches_second[v]) return false;
    for (const Index u : band.graph.neighbours(v)) reach(u);
  }
  return true;
}

// Returns the size of the smallest separator, found by testing every set of vertices.
Index smallest_separator(const SeparatorBand& band) {
  const Index n = band.graph.size();
  Index best = n;
  for (std::uint32_t set = 0; set < 1U << n; ++set) {
    const auto size = static_cast<Index>(std::popcount(set));
    if (size >= best) continue;
    std::vector<std::uint8_t> is_removed(n);
    for (Index v = 0; v < n; ++v) is_removed[v] = set >> v & 1;
    if (separates(band, is_removed)) best = size;
  }
  return best;
}

Index separator_size(const std::vector<Side>& sides) {
  return static_cast<Index>(std::count(sides.begin(), sides.end(), Side::separator));
}

bool is_valid(const SeparatorBand& band, const std::vector<Side>& sides) {
  for (Index v = 0; v < band.graph.size(); ++v) {
    if (band.touches_first[v] && sides[v] == Side::second) return false;
    if (band.touches_second[v] && sides[v] == Side::first) return false;
    for (const Index u : band.graph.neighbours(v))
      if (sides[v] == Side::first && sides[u] == Side::second) return false;
  }
  return true;
}

TEST(VertexSeparator, IsTheSmallestOfAll) {
  const bool holds = rc::check([] {
    const SeparatorBand band =
        random_band(*rc::gen::inRange<Index>(1, 11), *rc::gen::arbitrary<std::uint64_t>());
    const MinimumSeparators cuts = minimum_separators(band);
    const Index smallest = smallest_separator(band);
    for (const auto& sides : {cuts.near_first, cuts.near_second}) {
      RC_ASSERT(is_valid(band, sides));
      RC_ASSERT(separator_size(sides) == smallest);
    }
  });
  ASSERT_TRUE(holds);
}

TEST(VertexSeparator, OfNothingIsNothing) {
  EXPECT_TRUE(minimum_separators({}).near_first.empty());
}

}  // namespace
}  // namespace relievo::solver
