# Code is position-independent, so that the same objects make the static and the shared library, which calls its own
# functions directly. Warnings are errors in ./check alone, as other compilers warn of more. Contraction is off and
# fast-math never on: same input, same bits.
# Eigen adds up in one order everywhere, without packets, whose width depends on the processor: WebAssembly, too, gives
# the same bits. Its types keep the alignment that they have in programs that use packets.
function(relievo_compiler_options target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -ffp-contract=off -fno-math-errno)
  target_compile_definitions(${target} PRIVATE EIGEN_DONT_VECTORIZE EIGEN_MAX_STATIC_ALIGN_BYTES=16)
  if(NOT RELIEVO_WEB)
    target_compile_options(${target} PRIVATE -fPIC -fno-semantic-interposition)
  else()
    # A size has 32 bits there; the readers compare in 64 bits what files promise.
    target_compile_options(${target} PRIVATE -Wno-shorten-64-to-32)
    # Eigen's small functions are shorter in place than called, which compilers do not see where they save space.
    target_compile_definitions(${target} PRIVATE "EIGEN_STRONG_INLINE=inline __attribute__((always_inline))")
  endif()
  if(RELIEVO_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${RELIEVO_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options(${target} PUBLIC -fsanitize=${RELIEVO_SANITIZE})
  endif()
endfunction()
