// Turns failed allocations into errors. Tested by tests/core/within_memory_test.cpp.
#pragma once

#include <cstddef>
#include <new>
#include <stdexcept>

#include "relievo/core/error.h"

namespace relievo {

// Describes an operation for which memory may run out. An unknown number is 0.
struct MemoryNeed {
  std::size_t points = 0;
  double resolution_mm = 0;
};

// Returns an error of kind memory whose message states the known numbers. If there is not even memory for
// that message, the message is shorter.
Error memory_error(const MemoryNeed& need = {}) noexcept;

// Returns the Result of f, or an error of kind memory if an allocation in f failed, in any thread. If calls
// are nested, the error states the need of the innermost call.
template <typename F>
auto within_memory(const MemoryNeed& need, F&& f) -> decltype(f()) {
  try {
    return f();
  } catch (const std::bad_alloc&) {     // the memory that f allocated is free again
  } catch (const std::length_error&) {  // a vector would exceed its largest possible size
  }
  return std::unexpected(memory_error(need));
}
template <typename F>
auto within_memory(F&& f) -> decltype(f()) {
  return within_memory({}, std::forward<F>(f));
}

}  // namespace relievo
