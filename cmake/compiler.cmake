# Code is position-independent, so that the static and the shared library consist of the same objects. The shared
# library calls its own functions directly. Warnings are errors only in ./check, as other compilers have more warnings.
# Contraction and fast-math are off, so that the same input gives the same bits. Eigen does not use packets (SIMD),
# because their width depends on the processor. So Eigen adds up in the same order everywhere, and WebAssembly gives the
# same bits, too. Eigen's types keep the alignment that they have in programs with packets.
function(relievo_compiler_options target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -ffp-contract=off -fno-math-errno)
  target_compile_definitions(${target} PRIVATE EIGEN_DONT_VECTORIZE EIGEN_MAX_STATIC_ALIGN_BYTES=16)
  if(NOT RELIEVO_WEB)
    target_compile_options(${target} PRIVATE -fPIC -fno-semantic-interposition)
  else()
    # In WebAssembly, std::size_t has 32 bits. The readers check sizes from files with 64 bits.
    target_compile_options(${target} PRIVATE -Wno-shorten-64-to-32)
    # Inlining makes Eigen's small functions shorter, but compilers that optimise for size do not recognise that.
    target_compile_definitions(${target} PRIVATE "EIGEN_STRONG_INLINE=inline __attribute__((always_inline))")
  endif()
  if(RELIEVO_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${RELIEVO_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options(${target} PUBLIC -fsanitize=${RELIEVO_SANITIZE})
  endif()
endfunction()
