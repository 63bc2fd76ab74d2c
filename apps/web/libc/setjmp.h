// setjmp() and longjmp() for libpng: wasi-libc has none. clang turns a call of them into calls of the functions in
// setjmp.c, which throw and catch exceptions of WebAssembly.
#ifndef RELIEVO_WEB_SETJMP_H
#define RELIEVO_WEB_SETJMP_H

#ifdef __cplusplus
extern "C" {
#endif

typedef unsigned long jmp_buf[6];

int setjmp(jmp_buf) __attribute__((returns_twice));
void longjmp(jmp_buf, int) __attribute__((noreturn));

#ifdef __cplusplus
}
#endif

#endif
