// Makes allocations fail in the whole process: allocations of the library, of the libraries that it uses,
// and of all threads.
#pragma once

#include <cstddef>

namespace relievo::test {

struct AllocationFault {
  long first = 1;               // the first allocation that fails, counted from 1
  long count = 1;               // number of consecutive allocations that fail
  std::size_t least_bytes = 0;  // smaller allocations are not counted and do not fail
};

// Makes allocations fail until this object is destroyed. Only one such object may exist at a time.
class FailingAllocation {
 public:
  explicit FailingAllocation(const AllocationFault& fault);
  FailingAllocation(const FailingAllocation&) = delete;
  FailingAllocation& operator=(const FailingAllocation&) = delete;
  ~FailingAllocation();

  // Returns the number of allocations since the object was constructed.
  long counted() const;
};

}  // namespace relievo::test
