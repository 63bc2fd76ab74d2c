// Defines vectors whose width is the same on every processor, and chooses instructions at run time. Tested by
// tests/solver/cholesky_test.cpp and tests/scan/turning_test.cpp, HasTheSameBitsWithAndWithoutWideVectors.
#pragma once

// GCC warns that the instruction set determines how these vectors are passed to functions. This does no harm,
// because all our functions with vectors are inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace relievo {

// Vectors of eight or four floats, or four doubles. Code with them compiles to AVX2 inside RELIEVO_WIDE(),
// and to pairs of SSE2 instructions elsewhere. The results have the same bits, because products and sums are
// never contracted. The vectors need no alignment and may alias other types. They are typedefs, because clang
// ignores the alignment of a using-declaration.
typedef float Float8 __attribute__((vector_size(32), aligned(4), may_alias));
typedef float Float4 __attribute__((vector_size(16), aligned(4), may_alias));
typedef double Double4 __attribute__((vector_size(32), aligned(8), may_alias));

#if defined(__x86_64__)
#define RELIEVO_AVX2 __attribute__((target("avx2")))
#else
#define RELIEVO_AVX2
#endif
#define RELIEVO_INLINE inline __attribute__((always_inline))

// Returns the sum of the four numbers, which are added in the same order on every processor.
RELIEVO_INLINE double total(const Double4& four) {
  return (four[0] + four[1]) + (four[2] + four[3]);
}

// Returns whether RELIEVO_WIDE() uses AVX2. Initially it does if the processor has AVX2.
bool uses_avx2();

template <typename F>
RELIEVO_AVX2 decltype(auto) call_with_avx2(F&& f) {
  return f();
}

// Evaluates a call of a function marked RELIEVO_INLINE. The call is compiled twice: to AVX2, and to
// instructions that every processor has.
#define RELIEVO_WIDE(...) \
  (uses_avx2() ? call_with_avx2([&]() __attribute__((always_inline)) { return __VA_ARGS__; }) : (__VA_ARGS__))

// For tests: turns AVX2 off, or on again if the processor has AVX2.
void allow_avx2(bool is_allowed);

}  // namespace relievo
