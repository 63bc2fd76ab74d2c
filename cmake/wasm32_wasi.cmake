# The toolchain of the preset `web`: Debian's clang for WebAssembly, with wasi-libc. 128-bit vector instructions are
# always on. There are no threads and no C++ exceptions: code that throws ends the program, see
# apps/web/libc/exceptions.cpp.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang-19)
set(CMAKE_CXX_COMPILER clang++-19)
set(CMAKE_C_COMPILER_TARGET wasm32-wasi)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_AR llvm-ar-19)
set(CMAKE_RANLIB llvm-ranlib-19)
set(CMAKE_EXECUTABLE_SUFFIX .wasm)
set(CMAKE_C_FLAGS_INIT "-msimd128")
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fignore-exceptions -fno-rtti")
set(RELIEVO_WEB ON)

# CMake must not find files of the build machine, except those built by scripts/build-web-libraries.
set(RELIEVO_WEB_LIBRARIES ${CMAKE_CURRENT_LIST_DIR}/../build/web-libraries CACHE PATH "Folder of scripts/build-web-libraries")
set(CMAKE_FIND_ROOT_PATH ${RELIEVO_WEB_LIBRARIES})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
