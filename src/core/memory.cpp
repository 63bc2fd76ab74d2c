#include "core/memory.h"

#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace relievo {

LargeArray make_large_array(std::size_t floats) {
  // Large pages have 2 MB on x86 and ARM. Rounding small arrays up to whole large pages would waste memory.
  const std::size_t page = std::size_t{1} << 21, bytes = floats * sizeof(float);
  const std::size_t alignment = bytes >= 4 * page ? page : 64;
  const std::size_t rounded = (bytes / alignment + 1) * alignment;
  void* array = std::aligned_alloc(alignment, rounded);
  if (array == nullptr) {
    // The program may have set a handler that ends it cleanly. operator new calls that handler, too.
    if (const std::new_handler handler = std::get_new_handler()) handler();
    throw std::bad_alloc();
  }
#if defined(__linux__)
  // madvise() is only a request: if the system refuses it, reading is merely slower.
  if (alignment == page) static_cast<void>(madvise(array, rounded, MADV_HUGEPAGE));
#endif
  return LargeArray(static_cast<float*>(array));
}

}  // namespace relievo
