#include "core/simd.h"

#include <atomic>

namespace relievo {
namespace {

bool can_avx2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

std::atomic<bool>& is_on() {
  static std::atomic<bool> on = can_avx2();
  return on;
}

}  // namespace

bool uses_avx2() {
  return is_on().load(std::memory_order_relaxed);
}

void allow_avx2(bool is_allowed) {
  is_on().store(is_allowed && can_avx2(), std::memory_order_relaxed);
}

}  // namespace relievo
