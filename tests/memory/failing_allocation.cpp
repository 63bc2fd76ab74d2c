#include "memory/failing_allocation.h"

#include <atomic>
#include <cerrno>
#include <limits>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace relievo::test {
namespace {

constexpr long never = std::numeric_limits<long>::max();

std::atomic<long> counter = 0, first_that_fails = never, after_last = never;
std::atomic<std::size_t> least = 0;

bool fails(std::size_t bytes) {
  if (first_that_fails == never || bytes < least) return false;
  const long number = ++counter;
  const bool is_to_fail = number >= first_that_fails && number < after_last;
  if (is_to_fail) errno = ENOMEM;
  return is_to_fail;
}

}  // namespace

FailingAllocation::FailingAllocation(const AllocationFault& fault) {
  counter = 0;
  least = fault.least_bytes;
  after_last = fault.first + fault.count;
  first_that_fails = fault.first;
}

FailingAllocation::~FailingAllocation() {
  first_that_fails = never;
}

long FailingAllocation::counted() const {
  return counter;
}

}  // namespace relievo::test

using relievo::test::fails;

// These functions replace those of the C library for the whole process.
extern "C" {
void* malloc(std::size_t size) {
  return fails(size) ? nullptr : __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  return fails(count * size) ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  return fails(size) ? nullptr : __libc_realloc(block, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  return fails(size) ? nullptr : __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return fails(size) ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  if (fails(size)) return ENOMEM;
  *block = __libc_memalign(alignment, size);
  return *block ? 0 : ENOMEM;
}
}
