#include "native/call.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/memory_reserve.h"
#include "relievo/core/parallel.h"

namespace relievo::python {
namespace {

// The time between two checks for Ctrl-C. People perceive an answer within a tenth of a second as immediate.
constexpr std::chrono::milliseconds signal_interval(50);

// The number of running watched() calls for which this thread waits. It may be more than one, since a callback of
// one call may make another call.
thread_local int calls_of_this_thread = 0;

struct Event {
  std::string stage;
  double fraction = 0;
};

class Messages {
 public:
  void post(Event event) {
    const std::lock_guard lock(mutex_);
    events_.push_back(std::move(event));
    changed_.notify_all();
  }

  void end() {
    const std::lock_guard lock(mutex_);
    has_ended_ = true;
    changed_.notify_all();
  }

  // Waits for messages, but not longer than signal_interval. Returns false after the last message.
  bool wait(std::vector<Event>& events) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, signal_interval, [&] { return has_ended_ || !events_.empty(); });
    events.clear();
    events.swap(events_);
    return !has_ended_ || !events.empty();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Event> events_;
  bool has_ended_ = false;
};

void report(const py::object& callback, const std::vector<Event>& events) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (callback.is_none()) return;
  for (const Event& event : events) callback(event.stage, event.fraction);
}

struct CountedCall {
  CountedCall() { ++calls_of_this_thread; }
  ~CountedCall() { --calls_of_this_thread; }
};

// Ends the library's threads before a fork, since the child process would not have them, and starts them
// again afterwards.
class Fork {
 public:
  // Waits until no call of the library is running. A fork within a callback would wait for its own call for
  // ever, so begin() does not wait there. The child process of such a fork can use this module only after exec().
  void begin() {
    is_prepared_ = calls_of_this_thread == 0;
    if (!is_prepared_) return;
    const py::gil_scoped_release release;
    working().lock();
    threads_ = thread_count();
    set_thread_count(1);
  }

  void end_in_parent() {
    if (!std::exchange(is_prepared_, false)) return;
    set_thread_count(threads_);
    working().unlock();
  }

  // A thread of the parent process has locked the mutex, so the child makes a new mutex. This is safe, as the child has
  // no other thread.
  void end_in_child() {
    if (!std::exchange(is_prepared_, false)) return;
    std::construct_at(&working());
    set_thread_count(threads_);
  }

 private:
  bool is_prepared_ = false;
  int threads_ = 1;
};

void set_threads(int threads) {
  if (threads < 0 || threads > 256)
    throw py::value_error("threads: expected 0 for all, or a number up to 256, found " +
                          std::to_string(threads));
  if (calls_of_this_thread > 0)
    throw std::runtime_error("set_threads() cannot be called from a progress callback");
  const py::gil_scoped_release release;
  const std::lock_guard lock(working());
  set_thread_count(threads);
}

}  // namespace

std::shared_mutex& working() {
  static std::shared_mutex mutex;
  return mutex;
}

void watched(const py::object& callback, const std::function<void(Progress&)>& work) {
  app::refill_memory_reserve();
  Messages messages;
  Progress progress([&](std::string_view stage, double fraction) {
    messages.post({std::string(stage), fraction});
  });
  std::exception_ptr thrown, raised;
  const CountedCall counted;
  std::thread worker([&] {
    try {
      const std::shared_lock lock(working());
      work(progress);
    } catch (...) {
      thrown = std::current_exception();
    }
    messages.end();
  });
  std::vector<Event> events;
  const auto wait = [&] {
    const py::gil_scoped_release release;
    return messages.wait(events);
  };
  while (wait()) {
    if (raised) continue;
    try {
      report(callback, events);
    } catch (...) {
      raised = std::current_exception();
      progress.cancel();
    }
  }
  worker.join();
  if (raised) std::rethrow_exception(raised);
  if (thrown) std::rethrow_exception(thrown);
}

void add_threads(py::module_& module) {
  static Fork fork;
  module.def("set_threads", &set_threads);
  module.def("threads", [] { return unlocked([] { return thread_count(); }); });
  module.def("begin_fork", [] { fork.begin(); });
  module.def("end_fork_in_parent", [] { fork.end_in_parent(); });
  module.def("end_fork_in_child", [] { fork.end_in_child(); });
}

}  // namespace relievo::python
