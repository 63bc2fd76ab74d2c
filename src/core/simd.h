// Vectors of a fixed width, the same on every processor, and the choice of instructions at run time.
#pragma once

#include <cstring>

// How a vector would be passed to a function depends on the instructions; ours are inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace relievo {

// Eight floats or four doubles. Code written with them compiles to AVX2 inside a function marked
// RELIEVO_AVX2 and to pairs of SSE2 instructions elsewhere; both give the same bits, as products and sums
// are never contracted. Unaligned, and allowed to alias.
using Float8 = float __attribute__((vector_size(32), aligned(4), may_alias));
using Float4 = float __attribute__((vector_size(16), aligned(4), may_alias));
using Double4 = double __attribute__((vector_size(32), aligned(8), may_alias));

#if defined(__x86_64__)
#define RELIEVO_AVX2 __attribute__((target("avx2")))
#else
#define RELIEVO_AVX2
#endif
#define RELIEVO_INLINE inline __attribute__((always_inline))

// Whether functions marked RELIEVO_AVX2 are called: at first, if the processor can.
bool uses_avx2();

// For tests: turns them off, or on again where the processor can.
void allow_avx2(bool is_allowed);

}  // namespace relievo
