// Memory that runs out, as an error. Tested by tests/core/within_memory_test.cpp.
#pragma once

#include <cstddef>
#include <new>
#include <stdexcept>

#include "relievo/core/error.h"

namespace relievo {

// Describes work for which there may be too little memory; 0 stands for what is not known.
struct MemoryNeed {
  std::size_t points = 0;
  double resolution_mm = 0;
};

// Returns an error of kind memory that names what is known of the need. If not even its text can be allocated, it has a
// shorter one.
Error memory_error(const MemoryNeed& need = {}) noexcept;

// Returns what f returns, a Result, or an error of kind memory if an allocation in f failed, in whatever thread. Where
// calls of this function are nested, the innermost one names its need.
template <typename F>
auto within_memory(const MemoryNeed& need, F&& f) -> decltype(f()) {
  try {
    return f();
  } catch (const std::bad_alloc&) {     // what f had allocated is free again
  } catch (const std::length_error&) {  // a vector of more elements than there are addresses
  }
  return std::unexpected(memory_error(need));
}
template <typename F>
auto within_memory(F&& f) -> decltype(f()) {
  return within_memory({}, std::forward<F>(f));
}

}  // namespace relievo
