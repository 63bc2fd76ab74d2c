// Keeps a small reserve of memory for the moment when an allocation fails. The destructors of JSON allocate a
// few bytes, and an exception in a destructor would end the program.
#pragma once

namespace relievo::app {

// From now on, if operator new finds no memory, it frees the reserve and tries again. If that fails, too, it
// throws std::bad_alloc. Does nothing if the process already has a handler, as a process of Python may.
void keep_memory_in_reserve();

// Allocates the reserve again if it was freed and there is memory for it. May be called from any thread.
void refill_memory_reserve();

}  // namespace relievo::app
