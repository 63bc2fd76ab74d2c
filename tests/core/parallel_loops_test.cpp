// Loops of several threads at a time. What names std::thread is left out of the tests for WebAssembly, which has none.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// A loop that waited for the other one would wait for ever: that one ends after it.
TEST(ParallelLoops, DoNotWaitForTheEndOfALongOne) {
  set_thread_count(2);
  std::atomic<bool> has_begun = false, may_end = false;
  std::thread other([&] {
    parallel_for(
        4,
        [&](std::size_t) {
          has_begun = true;
          while (!may_end) std::this_thread::yield();
        },
        1);
  });
  while (!has_begun) std::this_thread::yield();
  std::vector<int> visits(100, 0);
  parallel_for(
      visits.size(), [&](std::size_t i) { ++visits[i]; }, 1);
  may_end = true;
  other.join();
  set_thread_count(0);
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
