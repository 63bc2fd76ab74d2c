# The target relievo_portable is the program without any shared library, not even glibc: one file for every Linux on the
# same kind of processor. It is linked from the objects of the program, static libraries of Debian, and the libraries
# built by scripts/build-static-libraries. If that script has not run, the target does not exist.
set(RELIEVO_STATIC_LIBRARIES ${PROJECT_SOURCE_DIR}/build/static CACHE PATH "Folder of scripts/build-static-libraries")
if(NOT EXISTS ${RELIEVO_STATIC_LIBRARIES}/libharfbuzz.a)
  message(STATUS "scripts/build-static-libraries has not run: there is no target relievo_portable")
  return()
endif()

add_executable(relievo_portable EXCLUDE_FROM_ALL $<TARGET_OBJECTS:relievo_cli> packaging/no_jbig.cpp)
relievo_compiler_options(relievo_portable)
target_link_options(relievo_portable PRIVATE -static -Wl,--gc-sections -s)
add_dependencies(relievo_portable relievo_studio)
target_link_directories(relievo_portable PRIVATE ${RELIEVO_STATIC_LIBRARIES})
target_link_libraries(relievo_portable PRIVATE
  $<TARGET_FILE:relievo_studio> $<TARGET_FILE:relievo_app> $<TARGET_FILE:relievo_samples> $<TARGET_FILE:relievo>
  cpp-httplib ssl crypto brotlienc brotlidec brotlicommon zip lzf harfbuzz fribidi
  spng tiff webp Lerc zstd lzma jpeg deflate z)
