// The functions that clang's -mllvm -wasm-enable-sjlj calls, see "C setjmp/longjmp in WebAssembly" in the tool
// conventions of WebAssembly.
#include <stdint.h>

// The beginning of a jmp_buf.
struct Jump {
  void* call;      // the call of the function that setjmp() was called in
  uint32_t label;  // the place of setjmp() in that function, from 1
  struct {
    void* jump;
    int value;
  } thrown;
};

void __wasm_setjmp(struct Jump* jump, uint32_t label, void* call) {
  jump->call = call;
  jump->label = label;
}

// Returns the place that a caught jump leads to in that call; 0 if it leads to another call.
uint32_t __wasm_setjmp_test(const struct Jump* jump, const void* call) {
  return jump->call == call ? jump->label : 0;
}

void __wasm_longjmp(struct Jump* jump, int value) {
  jump->thrown.jump = jump;
  jump->thrown.value = value == 0 ? 1 : value;
  __builtin_wasm_throw(1, &jump->thrown);  // 1 is the exception of C's jumps
}
