// Implements the functions that clang calls for setjmp() and longjmp(). A jump is a WebAssembly exception;
// the code that clang generates catches it.
#include <cstdint>

namespace {

struct State {
  void* call;           // identifies the call of the function that contains the setjmp()
  std::uint32_t place;  // number of that setjmp() within the function, from 1
  struct {
    void* state;
    int value;
  } thrown;
};

}  // namespace

extern "C" {

void __wasm_setjmp(State* state, std::uint32_t place, void* call) {
  state->call = call;
  state->place = place;
}

// Returns the number of the setjmp() to return to; 0 if another call of a function must catch the jump.
std::uint32_t __wasm_setjmp_test(const State* state, void* call) {
  return state->call == call ? state->place : 0;
}

[[noreturn]] void __wasm_longjmp(State* state, int value) {
  state->thrown = {state, value == 0 ? 1 : value};
  constexpr int tag_of_jumps = 1;
  __builtin_wasm_throw(tag_of_jumps, &state->thrown);
}
}

__asm__(".globl __c_longjmp\n.tagtype __c_longjmp i32\n__c_longjmp:\n");
