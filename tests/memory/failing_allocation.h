// Makes allocations of the whole process fail: those of the library, of the libraries below it, and of all
// threads.
#pragma once

#include <cstddef>

namespace relievo::test {

struct AllocationFault {
  long first = 1;               // the number of the first one that fails, counted from 1
  long count = 1;               // how many fail, one after the other
  std::size_t least_bytes = 0;  // smaller ones are not counted and do not fail
};

// Lets allocations fail for as long as it lives. There may be only one at a time.
class FailingAllocation {
 public:
  explicit FailingAllocation(const AllocationFault& fault);
  FailingAllocation(const FailingAllocation&) = delete;
  FailingAllocation& operator=(const FailingAllocation&) = delete;
  ~FailingAllocation();

  // Returns how many there were since this was made.
  long counted() const;
};

}  // namespace relievo::test
