// Calls the library without Python's lock (GIL), so that other threads can run meanwhile.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <shared_mutex>
#include <type_traits>

#include "native/errors.h"
#include "relievo/core/progress.h"

namespace relievo::python {

// Returns the mutex for the library's threads. It is locked shared while the library works, and exclusively
// while its threads are ended or started.
std::shared_mutex& working();

// Calls f without Python's lock. Only for short work, because signals are not handled meanwhile.
template <typename F>
auto unlocked(F&& f) {
  const py::gil_scoped_release release;
  const std::shared_lock lock(working());
  return f();
}

// Calls `work` in a new thread and waits for its end. Meanwhile the calling thread handles signals and, if
// `callback` is not None, calls it with the name of each stage and the fraction done. An exception from a
// signal or from `callback` cancels the work, and is raised after the work has ended.
void watched(const py::object& callback, const std::function<void(Progress&)>& work);

// Returns the value of the result of `work`, or raises its error.
template <typename F>
auto watched_value(const py::object& callback, F&& work) {
  std::optional<std::invoke_result_t<F, Progress&>> result;
  watched(callback, [&](Progress& progress) { result.emplace(work(progress)); });
  return value_or_raise(*std::move(result));
}

void add_threads(py::module_& module);

}  // namespace relievo::python
