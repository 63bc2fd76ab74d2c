// Makes C++ exceptions end the program, because this target of clang has no library that can throw them. The host
// throws its own exception instead, and must then discard the instance of the module.
#include <cstddef>
#include <cstring>
#include <new>

// Ends the program. The host provides this function in the module "relievo".
__attribute__((import_module("relievo"), import_name("fail"))) extern "C" [[noreturn]] void relievo_host_fail(
    const char* reason, std::size_t size);

namespace {

[[noreturn]] void fail(const char* reason) {
  relievo_host_fail(reason, std::strlen(reason));
}

// operator new calls this handler when malloc() has no memory left, before it would throw std::bad_alloc.
struct AtStart {
  AtStart() {
    std::set_new_handler([] { fail("memory"); });
  }
} at_start;

}  // namespace

extern "C" {

void* __cxa_allocate_exception(std::size_t) {
  fail("exception");
}

void __cxa_throw(void*, void*, void (*)(void*)) {
  fail("exception");
}
}
