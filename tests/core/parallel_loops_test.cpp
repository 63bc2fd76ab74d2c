// Tests loops that several threads run at the same time. The tests for WebAssembly omit this file, as it uses
// std::thread.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Waits until the flag is set, but at most a minute. So if the loops wait for each other, the test fails
// instead of running for ever.
bool is_set_in_time(const std::atomic<bool>& flag) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!flag && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  return flag;
}

// The long loop runs until the short loop has ended. If the short loop waited for the long loop, the long
// loop would give up after a minute, and the test would fail.
TEST(ParallelLoops, DoNotWaitForTheEndOfALongOne) {
  set_thread_count(2);
  std::atomic<bool> has_begun = false, may_end = false, has_given_up = false;
  std::thread other([&] {
    parallel_for(
        4,
        [&](std::size_t) {
          has_begun = true;
          if (!is_set_in_time(may_end)) has_given_up = true;
        },
        1);
  });
  EXPECT_TRUE(is_set_in_time(has_begun));
  std::vector<int> visits(100, 0);
  parallel_for(
      visits.size(), [&](std::size_t i) { ++visits[i]; }, 1);
  may_end = true;
  other.join();
  set_thread_count(0);
  EXPECT_FALSE(has_given_up);
  EXPECT_EQ(visits, std::vector<int>(100, 1));
}

TEST(ParallelLoops, OfSeveralThreadsVisitEveryElementOnce) {
  set_thread_count(2);
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (const std::size_t grain : {1, 2, 3, 4})
    threads.emplace_back([&wrong, grain] {
      for (std::size_t size = 0; size < 500; ++size) {
        std::vector<int> visits(size, 0);
        parallel_for(
            size, [&](std::size_t i) { ++visits[i]; }, grain);
        wrong += visits != std::vector<int>(size, 1);
      }
    });
  for (std::thread& thread : threads) thread.join();
  set_thread_count(0);
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace relievo
