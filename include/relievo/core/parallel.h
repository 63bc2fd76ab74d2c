// Parallel loops. Only this file of the library creates threads. On a system without threads, such as
// WebAssembly, the calling thread does all work. Work is cut into blocks whose limits depend only on the
// amount of work, never on the number of threads, so that results have the same bits for any number of
// threads. Tested by tests/core/parallel_test.cpp.
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

// Returns the number of threads that parallel calls use, the calling one included. Initially it is the number
// of hardware threads.
int thread_count();

// Sets the number of threads for the whole process, clamped to [1, 256]; 0 stands for the number of hardware
// threads. Must not be called while a parallel call runs.
void set_thread_count(int threads);

namespace detail {
using BlockFunction = void (*)(void* context, std::size_t block);
// Runs f(context, b) once for each b in [0, blocks), on all threads, and returns when all are done. Blocks
// are started in ascending order. If blocks throw, those that have not begun are skipped, and the exception
// of the lowest block that threw is rethrown: it is the same one for any number of threads. While the threads
// work for another call, and in a nested call, the calling thread works alone.
void run_blocks(std::size_t blocks, BlockFunction f, void* context);
}  // namespace detail

inline constexpr std::size_t default_grain = 4096;

// Calls f(begin, end) for consecutive ranges of at most `grain` elements that together are [0, n). The ranges
// run concurrently, so f may only write data of its own range. If f throws, some later ranges are skipped,
// and the calling thread gets the exception. This applies to all functions below.
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

// Calls both functions, concurrently or one after the other, so neither may wait for the other. A parallel
// call inside one of them runs only on that function's thread.
template <typename First, typename Second>
void parallel_both(First&& first, Second&& second) {
  parallel_for(
      2, [&](std::size_t i) { i == 0 ? first() : second(); }, 1);
}

// Returns merge(...merge(merge(start, map(range 0)), map(range 1))...). Ranges are mapped concurrently and
// merged in order, so that sums of floating-point numbers do not depend on the number of threads.
template <typename T, typename Map, typename Merge>
T parallel_reduce(std::size_t n, T start, Map&& map, Merge&& merge, std::size_t grain = default_grain) {
  std::vector<T> parts((n + grain - 1) / grain, start);
  parallel_ranges(n, grain,
                  [&](std::size_t begin, std::size_t end) { parts[begin / grain] = map(begin, end); });
  for (const T& part : parts) start = merge(start, part);
  return start;
}

// One flag per block, for blocks that need the results of earlier ones. A block may only wait for a block of
// the same parallel call with a lower number: as blocks are started in order, the awaited block is running or
// done, so that there is no deadlock.
class BlockFlags {
 public:
  explicit BlockFlags(std::size_t blocks = 0) : flags_(blocks) {}

  void reset() {
    for (auto& flag : flags_) flag.store(0, std::memory_order_relaxed);
  }
  void set(std::size_t block) { flags_[block].store(1, std::memory_order_release); }
  // Returns when the flag is set. Everything that was written before set() is then visible. Throws if the
  // flag will never be set because an earlier block threw.
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

// A value that threads share. with() is the only access to it and admits one caller at a time.
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

// A thread that calls one function repeatedly as long as the function returns true, and then sleeps until
// wake(). The loop's methods may be called from any other thread. If the function throws, the loop sleeps as
// if it had returned false. Where there are no threads, wait_until_idle() calls the function.
class BackgroundLoop {
 public:
  explicit BackgroundLoop(std::function<bool()> step);
  ~BackgroundLoop();  // waits for the running step to end

  void wake();

  // Waits until the loop sleeps and has nothing left to do. Returns false if that takes longer than the
  // timeout. Without threads no call of the function begins after the timeout.
  bool wait_until_idle(std::chrono::milliseconds timeout);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo
