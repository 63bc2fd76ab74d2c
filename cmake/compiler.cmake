# Code is position-independent, so that the same objects make the static and the shared library, which calls its own
# functions directly. Warnings are errors on our own targets. Contraction is off and fast-math never on: same input, same bits.
function(relievo_compiler_options target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror -ffp-contract=off -fno-math-errno
    -fPIC -fno-semantic-interposition)
  if(RELIEVO_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${RELIEVO_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options(${target} PUBLIC -fsanitize=${RELIEVO_SANITIZE})
  endif()
endfunction()
