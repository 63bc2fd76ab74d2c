// Tests parallel calls in which blocks throw exceptions, as they do when memory runs out. Builds
// without exceptions, such as WebAssembly, omit these tests.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <new>
#include <thread>
#include <vector>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

class FailingBlocks : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { set_thread_count(GetParam()); }
  void TearDown() override { set_thread_count(0); }
};

struct Failure {
  std::size_t block;
};

// Returns the block whose exception the parallel call throws; `blocks` if it throws none.
template <typename F>
std::size_t failed_block(std::size_t blocks, F&& f) {
  try {
    parallel_for(blocks, f, 1);
  } catch (const Failure& failure) {
    return failure.block;
  }
  return blocks;
}

TEST_P(FailingBlocks, GiveTheCallerTheirException) {
  EXPECT_THROW(parallel_for(
                   1000, [](std::size_t i) { return i == 500 ? throw std::bad_alloc() : void(); }, 1),
               std::bad_alloc);
  EXPECT_THROW(
      parallel_reduce(
          100, 0, [](std::size_t, std::size_t) -> int { throw std::bad_alloc(); }, std::plus<>(), 10),
      std::bad_alloc);
  EXPECT_THROW(parallel_both([] { throw std::bad_alloc(); }, [] {}), std::bad_alloc);
}

// The lowest failing block waits a while for another block to fail, so that a higher block often fails first.
TEST_P(FailingBlocks, GiveTheExceptionOfTheLowestOne) {
  for (std::size_t first = 0; first < 60; ++first) {
    std::atomic<bool> has_other_failed = false;
    const auto fail = [&](std::size_t block) {
      if (block < first) return;
      for (int look = 0; block == first && look < 2000 && !has_other_failed; ++look)
        std::this_thread::yield();
      has_other_failed = has_other_failed || block > first;
      throw Failure{block};
    };
    EXPECT_EQ(failed_block(64, fail), first);
  }
}

TEST_P(FailingBlocks, LeaveOutThoseThatHaveNotBegun) {
  std::atomic<int> begun = 0;
  EXPECT_EQ(failed_block(100000,
                         [&](std::size_t block) {
                           ++begun;
                           throw Failure{block};
                         }),
            0U);
  EXPECT_LE(begun, GetParam());
}

// Each block waits for the previous one. So the blocks after a failing block would wait for ever if
// the failure did not end their waiting.
TEST_P(FailingBlocks, EndTheWaitOfOthers) {
  for (std::size_t failing = 0; failing < 50; ++failing) {
    BlockFlags done(50);
    std::vector<int> visits(50, 0);
    const auto work = [&](std::size_t block) {
      if (block > 0) done.wait(block - 1);
      if (block == failing) throw Failure{block};
      ++visits[block];
      done.set(block);
    };
    EXPECT_EQ(failed_block(50, work), failing);
    for (std::size_t block = 0; block < 50; ++block) EXPECT_EQ(visits[block], block < failing ? 1 : 0);
  }
}

TEST_P(FailingBlocks, PassOutOfNestedCalls) {
  EXPECT_EQ(
      failed_block(8,
                   [&](std::size_t block) {
                     parallel_for(
                         8, [&](std::size_t inner) { return inner == 5 ? throw Failure{block} : void(); }, 1);
                   }),
      0U);
}

TEST_P(FailingBlocks, DoNotHarmTheNextCall) {
  for (int time = 0; time < 100; ++time) {
    EXPECT_EQ(failed_block(20, [](std::size_t block) { return block == 7 ? throw Failure{block} : void(); }),
              7U);
    std::vector<int> visits(100, 0);
    parallel_for(
        visits.size(), [&](std::size_t i) { ++visits[i]; }, 1);
    EXPECT_EQ(visits, std::vector<int>(100, 1));
  }
}

TEST(BackgroundLoop, SleepsAfterAStepThatThrows) {
  std::atomic<int> steps = 0;
  BackgroundLoop loop([&]() -> bool {
    if (++steps == 1) throw std::bad_alloc();
    return false;
  });
  loop.wake();
  ASSERT_TRUE(loop.wait_until_idle(std::chrono::minutes(1)));
  EXPECT_EQ(steps, 1);
  loop.wake();
  ASSERT_TRUE(loop.wait_until_idle(std::chrono::minutes(1)));
  EXPECT_EQ(steps, 2);
}

INSTANTIATE_TEST_SUITE_P(Threads, FailingBlocks, testing::Values(1, 2, 4), testing::PrintToStringParamName());

}  // namespace
}  // namespace relievo
