#include "relievo/core/parallel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace relievo {
namespace {

class Parallel : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { set_thread_count(GetParam()); }
  void TearDown() override { set_thread_count(0); }
};

TEST_P(Parallel, HonoursTheNumberOfThreads) {
#if defined(__wasi__)
  EXPECT_EQ(thread_count(), 1);
#else
  EXPECT_EQ(thread_count(), GetParam());
#endif
}

TEST_P(Parallel, VisitsEveryElementOnce) {
  for (const std::size_t n : {0, 1, 4095, 4096, 4097, 100000}) {
    std::vector<int> visits(n, 0);
    parallel_for(n, [&](std::size_t i) { ++visits[i]; });
    EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), static_cast<std::ptrdiff_t>(n));
  }
}

TEST_P(Parallel, SumsHaveTheSameBitsForAnyNumberOfThreads) {
  const auto sum = [] {
    return parallel_reduce(
        100000, 0.0,
        [](std::size_t begin, std::size_t end) {
          double s = 0;
          for (std::size_t i = begin; i < end; ++i) s += std::sin(static_cast<double>(i));
          return s;
        },
        std::plus<>(), 1000);
  };
  const double ours = sum();
  set_thread_count(1);
  EXPECT_EQ(ours, sum());
}

TEST_P(Parallel, NestedCallsComplete) {
  std::vector<int> visits(64 * 64, 0);
  parallel_for(
      64,
      [&](std::size_t i) {
        parallel_for(
            64, [&](std::size_t j) { ++visits[i * 64 + j]; }, 1);
      },
      1);
  EXPECT_EQ(std::accumulate(visits.begin(), visits.end(), 0), 64 * 64);
}

TEST_P(Parallel, BothCallsComplete) {
  std::vector<int> first(5000, 0), second(5000, 0);
  parallel_both(
      [&] {
        parallel_for(
            first.size(), [&](std::size_t i) { ++first[i]; }, 64);
      },
      [&] {
        parallel_for(
            second.size(), [&](std::size_t i) { ++second[i]; }, 64);
      });
  EXPECT_EQ(first, std::vector<int>(5000, 1));
  EXPECT_EQ(second, std::vector<int>(5000, 1));
}

INSTANTIATE_TEST_SUITE_P(Threads, Parallel, testing::Values(1, 2, 4), testing::PrintToStringParamName());

}  // namespace
}  // namespace relievo
