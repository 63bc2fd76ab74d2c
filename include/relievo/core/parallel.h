// Runs loops in parallel. The library creates threads only here. On systems without threads, such as
// WebAssembly, the calling thread does everything. Loops are divided into blocks. The limits of the blocks
// depend on the number of elements, but not on the number of threads, so that results have the same bits for
// any number of threads. Tested by tests/core/parallel_test.cpp.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace relievo {

// Returns the number of threads for parallel calls, including the calling one. Initially it is the number of
// hardware threads.
int thread_count();

// Sets the number of threads for the whole process, clamped to [1, 256]; 0 means the number of hardware
// threads. Must not be called during a parallel call.
void set_thread_count(int threads);

namespace detail {
using BlockFunction = void (*)(void* context, std::size_t block);
// Runs f(context, b) once for each b in [0, blocks), on all threads, and returns when all are done. Blocks
// are started in ascending order. If blocks throw, blocks that have not begun are skipped. The exception of
// the lowest throwing block is rethrown, and that block is the same for any number of threads. In a nested
// call, and while the other threads serve another call, the calling thread runs all blocks alone.
void run_blocks(std::size_t blocks, BlockFunction f, void* context);
}  // namespace detail

inline constexpr std::size_t default_grain = 4096;

// Calls f(begin, end) for consecutive ranges of at most `grain` elements that together cover [0, n). The
// ranges run concurrently, so f may write only data that belongs to its range. If f throws, here or in one of
// the parallel functions below, some later ranges are skipped, and the calling thread gets the exception.
template <typename F>
void parallel_ranges(std::size_t n, std::size_t grain, F&& f) {
  struct Context {
    F& f;
    std::size_t n, grain;
  } context{f, n, grain};
  detail::run_blocks((n + grain - 1) / grain,
                     [](void* c, std::size_t b) {
                       const Context& it = *static_cast<Context*>(c);
                       it.f(b * it.grain, std::min(it.n, (b + 1) * it.grain));
                     },
                     &context);
}

// Calls f(i) for each i in [0, n), concurrently.
template <typename F>
void parallel_for(std::size_t n, F&& f, std::size_t grain = default_grain) {
  parallel_ranges(n, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) f(i);
  });
}

// Calls both functions, concurrently or one after the other; neither may wait for the other. A parallel call
// inside one of them uses only that function's thread.
template <typename First, typename Second>
void parallel_both(First&& first, Second&& second) {
  parallel_for(
      2, [&](std::size_t i) { i == 0 ? first() : second(); }, 1);
}

// Returns merge(...merge(merge(start, map(range 0)), map(range 1))...). Ranges are mapped concurrently but
// merged in order, so floating-point sums do not depend on the number of threads.
template <typename T, typename Map, typename Merge>
T parallel_reduce(std::size_t n, T start, Map&& map, Merge&& merge, std::size_t grain = default_grain) {
  std::vector<T> parts((n + grain - 1) / grain, start);
  parallel_ranges(n, grain,
                  [&](std::size_t begin, std::size_t end) { parts[begin / grain] = map(begin, end); });
  for (const T& part : parts) start = merge(start, part);
  return start;
}

// One flag per block of a parallel call, for blocks that need the results of earlier blocks. A block may wait
// only for a lower block of the same call. Waiting cannot deadlock, because blocks are started in order, so
// that the lower block is running or done.
class BlockFlags {
 public:
  explicit BlockFlags(std::size_t blocks = 0) : flags_(blocks) {}

  void reset() {
    for (auto& flag : flags_) flag.store(0, std::memory_order_relaxed);
  }
  void set(std::size_t block) { flags_[block].store(1, std::memory_order_release); }
  // Returns when the flag is set. Everything written before set() is then visible. Throws if the flag will
  // never be set because an earlier block threw.
  void wait(std::size_t block) const;

 private:
  std::vector<std::atomic<std::uint8_t>> flags_;
};

// Admits one thread at a time.
#if defined(__wasi__)
class Mutex {
 public:
  void lock() {}
  void unlock() {}
};
#else
using Mutex = std::mutex;
#endif
using Lock = std::lock_guard<Mutex>;

// A value that several threads share. Only with() gives access to the value, and only to one thread at a
// time.
template <typename T>
class Guarded {
 public:
  template <typename F>
  decltype(auto) with(F&& f) {
    const Lock lock(mutex_);
    return std::forward<F>(f)(value_);
  }
  template <typename F>
  decltype(auto) with(F&& f) const {
    const Lock lock(mutex_);
    return std::forward<F>(f)(value_);
  }

 private:
  mutable Mutex mutex_;
  T value_;
};

// A thread that calls a function repeatedly as long as the function returns true, and then sleeps until
// wake(). If the function throws, the thread sleeps, too. Methods may be called from any other thread. On
// systems without threads, wait_until_idle() calls the function.
class BackgroundLoop {
 public:
  explicit BackgroundLoop(std::function<bool()> step);
  ~BackgroundLoop();  // waits for the end of the running call

  void wake();

  // Waits until the loop sleeps and has nothing left to do. Returns false if that takes longer than the
  // timeout. On systems without threads, no call of the function begins after the timeout.
  bool wait_until_idle(std::chrono::milliseconds timeout);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo
