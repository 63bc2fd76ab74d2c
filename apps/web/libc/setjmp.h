// Replaces the standard header, which Debian's wasi-libc lacks, for sources that are compiled with -mllvm
// -wasm-enable-sjlj.
#pragma once

extern "C" {
using jmp_buf = long[4];
int setjmp(jmp_buf state) __attribute__((returns_twice));
[[noreturn]] void longjmp(jmp_buf state, int value);
}
