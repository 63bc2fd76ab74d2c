// C++ exceptions end the program, as clang's target has no library that can throw them. The host throws an
// exception of its own, and must then discard the instance.
#include <cstddef>
#include <cstring>
#include <new>

// Ends the program in the host, which provides this as a function of the module "relievo".
__attribute__((import_module("relievo"), import_name("fail"))) extern "C" [[noreturn]] void relievo_host_fail(
    const char* reason, std::size_t size);

namespace {

[[noreturn]] void fail(const char* reason) {
  relievo_host_fail(reason, std::strlen(reason));
}

// Called when malloc() has no memory left, before std::bad_alloc would be thrown.
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
