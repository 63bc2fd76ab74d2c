# Builds the tests of rooms as WebAssembly, which Node runs. Leaves out tests that need threads, files, exceptions (as
# RapidCheck does) or a second library.
set(RELIEVO_GTEST_SOURCE /usr/src/googletest/googletest CACHE PATH "Sources of GoogleTest, of Debian's package googletest")
add_library(relievo_gtest STATIC ${RELIEVO_GTEST_SOURCE}/src/gtest-all.cc ${RELIEVO_GTEST_SOURCE}/src/gtest_main.cc
  ${PROJECT_SOURCE_DIR}/apps/web/libc/exceptions.cpp ${PROJECT_SOURCE_DIR}/apps/web/libc/setjmp.cpp)
set_source_files_properties(${PROJECT_SOURCE_DIR}/apps/web/libc/setjmp.cpp PROPERTIES COMPILE_OPTIONS -mexception-handling)
target_include_directories(relievo_gtest SYSTEM PUBLIC ${RELIEVO_GTEST_SOURCE}/include PRIVATE ${RELIEVO_GTEST_SOURCE})
target_compile_definitions(relievo_gtest PUBLIC GTEST_HAS_PTHREAD=0 GTEST_HAS_EXCEPTIONS=0 GTEST_HAS_STREAM_REDIRECTION=0
  GTEST_HAS_DEATH_TEST=0 GTEST_HAS_FILE_SYSTEM=0 GTEST_HAS_RTTI=0)

find_program(NODE node REQUIRED)
foreach(room core geometry solver scan relief lettering plate picture io pipeline quality samples)
  file(GLOB candidates CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${room}/*_test.cpp)
  set(sources "")
  foreach(source IN LISTS candidates)
    file(READ ${source} text)
    if(NOT text MATCHES "rapidcheck|fstream|std::thread|qhull|bad_alloc|shared_scans|admesh|png[.]h")
      list(APPEND sources ${source})
    endif()
  endforeach()
  add_executable(relievo_${room}_web_tests ${sources})
  target_include_directories(relievo_${room}_web_tests PRIVATE ${PROJECT_SOURCE_DIR}/src ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(relievo_${room}_web_tests PRIVATE relievo_gtest relievo_samples nanoflann::nanoflann
    nlohmann_json::nlohmann_json)
  relievo_compiler_options(relievo_${room}_web_tests)
  target_compile_options(relievo_${room}_web_tests PRIVATE -O1 -UEIGEN_NO_IO -Wno-missing-field-initializers -Wno-dangling-else)  # tests print points
  target_link_options(relievo_${room}_web_tests PRIVATE -Wl,-z,stack-size=1048576 -Wl,--max-memory=4294967296)
  add_test(NAME web.${room} COMMAND ${NODE} ${PROJECT_SOURCE_DIR}/npm/test/run.mjs $<TARGET_FILE:relievo_${room}_web_tests>)
  set_tests_properties(web.${room} PROPERTIES TIMEOUT 600)
endforeach()
