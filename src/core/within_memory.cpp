#include "relievo/core/within_memory.h"

#include "relievo/core/text.h"

namespace relievo {
namespace {

std::string words_of(const MemoryNeed& need) {
  std::string words = "expected more free memory";
  if (need.points > 0) append(words, cat(" for ", need.points, " points"));
  if (need.resolution_mm > 0) append(words, cat(" at a resolution of ", need.resolution_mm, " mm"));
  return words += ", found none left";
}

}  // namespace

Error memory_error(const MemoryNeed& need) noexcept {
  Error error{ErrorKind::memory, {}, {}, {}};
  try {
    error.expected = words_of(need);
  } catch (const std::bad_alloc&) {
    error.expected = "expected memory";  // short enough for a string that allocates nothing
  }
  return error;
}

}  // namespace relievo
