// Keeps a small reserve of memory for the moment when an allocation fails. Even then a few bytes are needed,
// because the destructors of JSON values allocate memory. An exception in a destructor would end the program.
#pragma once

namespace relievo::app {

// Installs a handler for operator new: if memory runs out, the handler frees the reserve, and operator new
// tries again. If that fails, too, operator new throws std::bad_alloc. Does nothing if the process already
// has a handler, which is possible in a Python process.
void keep_memory_in_reserve();

// Allocates the reserve again if it was freed and there is memory for it. May be called from any thread.
void refill_memory_reserve();

}  // namespace relievo::app
