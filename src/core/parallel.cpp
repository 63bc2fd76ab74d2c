#include "relievo/core/parallel.h"

#include <condition_variable>
#include <exception>
#include <limits>
#include <new>
#include <system_error>
#include <thread>

namespace relievo {
namespace {

struct Job;

// The block that a thread processes; `job` is null between blocks. A nested parallel call runs immediately
// and only on this thread, because the other threads have blocks of their own.
struct BlockAtWork {
  const Job* job = nullptr;
  std::size_t block = 0;
};
thread_local BlockAtWork at_work;

// Thrown by a block that waits for a block that will never be done.
struct Abandoned {};

// The blocks of one parallel call. Threads take the next block from a shared counter until none is left.
struct Job {
  detail::BlockFunction f = nullptr;
  void* context = nullptr;
  std::size_t blocks = 0;
  std::atomic<std::size_t> next = 0;
  std::atomic<std::size_t> first_failed = std::numeric_limits<std::size_t>::max();
  std::mutex failing{};               // guards the exception
  std::exception_ptr exception = {};  // exception of block first_failed

  // Stores the exceptions of blocks, and throws none. If an exception left this function in the caller's
  // thread, the job would be destroyed while other threads are still working on it.
  void work() noexcept {
    while (work_on_next()) {
    }
  }

  // Processes the next block. Returns false if none was left.
  bool work_on_next() noexcept {
    const std::size_t b = next++;
    if (b >= blocks) return false;
    at_work = {this, b};
    try {
      f(context, b);
    } catch (...) {
      fail(b);
    }
    at_work = {};
    return true;
  }

  // Stores the exception of the failing block with the lowest index. All blocks with lower indices have begun
  // already, so this block is the same for any number of threads.
  void fail(std::size_t block) {
    const std::lock_guard lock(failing);
    next = blocks;
    if (block > first_failed) return;
    first_failed = block;
    exception = std::current_exception();
  }

  // Returns whether an earlier block than `block` has failed. If so, `block` is abandoned, because it may be
  // waiting for a block that will never begin. A single thread would not have begun `block`.
  bool has_failed_before(std::size_t block) const { return first_failed < block; }
};

// The worker threads, which sleep between jobs and process one job at a time. While the workers are busy,
// another caller processes its own job alone. So a picture need not wait for a job of half a second.
class Pool {
 public:
  static Pool& instance() {
    static Pool pool;
    return pool;
  }

  ~Pool() { stop(); }

  int size() const { return static_cast<int>(workers_.size()) + 1; }

  void resize(int threads) {
    const std::lock_guard lock(resizing_);
    const int most = 256;
    if (threads <= 0) threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    threads = std::min(threads, most);
    if (threads == size()) return;
    stop();
    start(threads - 1);
  }

  // The caller processes blocks, too. It returns only after every worker has left the job, because the job is
  // on the caller's stack.
  void run(std::size_t blocks, detail::BlockFunction f, void* context) {
    Job job{f, context, blocks};
    work_on(job);
    if (job.exception) std::rethrow_exception(job.exception);
  }

 private:
  Pool() { start(static_cast<int>(std::max(1U, std::thread::hardware_concurrency())) - 1); }

  void work_on(Job& job) {
    while (!try_give(job))
      if (!job.work_on_next()) return;
    wake_.notify_all();
    job.work();
    std::unique_lock lock(mutex_);
    done_.wait(lock, [&] { return busy_ == 0; });
    job_ = nullptr;
  }

  // Starts the given number of workers, or fewer if the system or its memory does not allow more. Results do
  // not depend on the number of workers.
  void start(int workers) {
    is_stopping_ = false;
    try {
      for (int i = 0; i < workers; ++i) workers_.emplace_back([this, seen = generation_] { loop(seen); });
    } catch (const std::system_error&) {
    } catch (const std::bad_alloc&) {
    }
  }

  // Passes the job to the workers, unless they are processing another job. Returns whether the workers have
  // taken it.
  bool try_give(Job& job) {
    const std::lock_guard lock(mutex_);
    if (job_) return false;
    job_ = &job;
    busy_ = workers_.size();
    ++generation_;
    return true;
  }

  void stop() {
    {
      const std::lock_guard lock(mutex_);
      is_stopping_ = true;
    }
    wake_.notify_all();
    for (std::thread& worker : workers_) worker.join();
    workers_.clear();
  }

  // `seen` is the number of the last job that the worker has seen, so that each worker takes each job only
  // once.
  void loop(std::size_t seen) {
    std::unique_lock lock(mutex_);
    for (;;) {
      wake_.wait(lock, [&] { return is_stopping_ || generation_ != seen; });
      if (is_stopping_) return;
      seen = generation_;
      Job* job = job_;
      lock.unlock();
      job->work();
      lock.lock();
      if (--busy_ == 0) done_.notify_one();
    }
  }

  std::mutex resizing_;
  std::vector<std::thread> workers_;  // changes only while no parallel call runs
  std::mutex mutex_;                  // guards the members below
  std::condition_variable wake_, done_;
  Job* job_ = nullptr;
  std::size_t busy_ = 0, generation_ = 0;
  bool is_stopping_ = false;
};

}  // namespace

int thread_count() {
  return Pool::instance().size();
}

void set_thread_count(int threads) {
  Pool::instance().resize(threads);
}

void detail::run_blocks(std::size_t blocks, BlockFunction f, void* context) {
  if (blocks <= 1 || at_work.job || thread_count() == 1) {
    for (std::size_t b = 0; b < blocks; ++b) f(context, b);
  } else {
    Pool::instance().run(blocks, f, context);
  }
}

void BlockFlags::wait(std::size_t block) const {
  // Waits are usually short, so the thread spins at first, and yields to other threads only after a while.
  for (int look = 0; flags_[block].load(std::memory_order_acquire) == 0; ++look)
    if (look > 2000) {
      if (at_work.job && at_work.job->has_failed_before(at_work.block)) throw Abandoned{};
      std::this_thread::yield();
    }
}

// Exists until the thread has ended, because the destructor of BackgroundLoop joins the thread.
struct BackgroundLoop::State {
  std::function<bool()> step;
  std::mutex mutex;
  std::condition_variable changed;
  bool is_woken = false, is_working = false, is_ending = false;
  std::thread thread;

  bool is_to_go_on() noexcept {
    try {
      return step();
    } catch (...) {
      return false;
    }
  }

  void run() {
    std::unique_lock lock(mutex);
    for (;;) {
      changed.wait(lock, [&] { return is_ending || is_woken; });
      if (is_ending) return;
      is_woken = false;
      is_working = true;
      lock.unlock();
      const bool goes_on = is_to_go_on();
      lock.lock();
      is_working = false;
      is_woken |= goes_on;
      changed.notify_all();
    }
  }
};

BackgroundLoop::BackgroundLoop(std::function<bool()> step) : state_(std::make_unique<State>()) {
  state_->step = std::move(step);
  state_->thread = std::thread([state = state_.get()] { state->run(); });
}

BackgroundLoop::~BackgroundLoop() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->is_ending = true;
  }
  state_->changed.notify_all();
  state_->thread.join();
}

void BackgroundLoop::wake() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->is_woken = true;
  }
  state_->changed.notify_all();
}

bool BackgroundLoop::wait_until_idle(std::chrono::milliseconds timeout) {
  std::unique_lock lock(state_->mutex);
  return state_->changed.wait_for(lock, timeout, [&] { return !state_->is_woken && !state_->is_working; });
}

}  // namespace relievo
