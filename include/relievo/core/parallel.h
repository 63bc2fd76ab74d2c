// The one place that knows threads. Work is cut into blocks whose limits depend on the size alone, never on
// the number of threads, so that results are the same bits for any number.
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

// Number of threads that parallel calls use, this one included; at first what the machine has.
int thread_count();

// Sets it for the whole process, clamped to [1, 256]; 0 means what the machine has. Call it while no parallel
// call runs.
void set_thread_count(int threads);

namespace detail {
using BlockFunction = void (*)(void* context, std::size_t block);
// Runs f(context, b) once for each b in [0, blocks), on all threads; returns when all are done. Blocks are
// begun in ascending order. A nested call runs on the calling thread alone.
void run_blocks(std::size_t blocks, BlockFunction f, void* context);
}  // namespace detail

inline constexpr std::size_t default_grain = 4096;

// Calls f(begin, end) for consecutive ranges of at most `grain` elements that cover [0, n). The ranges run
// concurrently: f may write only what belongs to its own range. f must not throw.
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

// Returns merge(...merge(merge(start, map(range 0)), map(range 1))...): ranges are mapped concurrently,
// merged in order, so that sums of floating-point numbers do not depend on the number of threads.
template <typename T, typename Map, typename Merge>
T parallel_reduce(std::size_t n, T start, Map&& map, Merge&& merge, std::size_t grain = default_grain) {
  std::vector<T> parts((n + grain - 1) / grain, start);
  parallel_ranges(n, grain,
                  [&](std::size_t begin, std::size_t end) { parts[begin / grain] = map(begin, end); });
  for (const T& part : parts) start = merge(start, part);
  return start;
}

// One flag per block, for blocks that need the results of earlier ones. A block may wait for a block of a
// lower number of the same parallel call, and no other: as blocks are begun in order, that one is under way.
class BlockFlags {
 public:
  explicit BlockFlags(std::size_t blocks = 0) : flags_(blocks) {}

  void reset() {
    for (auto& flag : flags_) flag.store(0, std::memory_order_relaxed);
  }
  void set(std::size_t block) { flags_[block].store(1, std::memory_order_release); }
  // Returns when the flag is set; what was written before is then visible.
  void wait(std::size_t block) const;

 private:
  std::vector<std::atomic<std::uint8_t>> flags_;
};

// A value that threads share: with() is the only way to it, one caller at a time.
template <typename T>
class Guarded {
 public:
  template <typename F>
  decltype(auto) with(F&& f) {
    const std::lock_guard lock(mutex_);
    return std::forward<F>(f)(value_);
  }
  template <typename F>
  decltype(auto) with(F&& f) const {
    const std::lock_guard lock(mutex_);
    return std::forward<F>(f)(value_);
  }

 private:
  mutable std::mutex mutex_;
  T value_;
};

// A thread of its own that calls one function again and again, as long as that returns true, and then sleeps
// until wake(). Its methods may be called from any thread but that one.
class BackgroundLoop {
 public:
  explicit BackgroundLoop(std::function<bool()> step);
  ~BackgroundLoop();  // ends after the running step

  void wake();

  // Waits until the loop sleeps and was not woken since. Returns false if that takes longer than the timeout.
  bool wait_until_idle(std::chrono::milliseconds timeout);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo
