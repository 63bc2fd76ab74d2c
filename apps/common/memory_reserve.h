// Keeps a small reserve of memory for the moment when an allocation fails. The destructors of JSON allocate a
// few bytes, and an exception in a destructor would end the program.
#pragma once

namespace relievo::app {

// From now on an allocation by operator new that fails is tried again after the reserve was freed, and throws
// std::bad_alloc if it fails again. Does nothing if the process already has a handler, as a process of Python
// may.
void keep_memory_in_reserve();

// Takes a new reserve if the last one was freed and there is memory for it again. May be called from any thread.
void refill_memory_reserve();

}  // namespace relievo::app
