#include "common/memory_reserve.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace relievo::app {
namespace {

// The reserve is so small that the allocator places it among other small allocations, and can reuse its memory as
// soon as it is freed.
constexpr std::size_t reserve_bytes = 64U << 10;

std::atomic<void*> reserve = nullptr;

void free_reserve() {
  void* const block = reserve.exchange(nullptr);
  if (!block) throw std::bad_alloc();
  std::free(block);
}

}  // namespace

void keep_memory_in_reserve() {
  if (std::get_new_handler()) return;
  refill_memory_reserve();
  std::set_new_handler(free_reserve);
}

void refill_memory_reserve() {
  if (reserve.load()) return;
  void* none = nullptr;
  void* const block = std::malloc(reserve_bytes);
  if (!reserve.compare_exchange_strong(none, block)) std::free(block);
}

}  // namespace relievo::app
