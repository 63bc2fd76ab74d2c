# The shared library exports only the functions of the public headers, which packaging/symbols.txt lists.
# scripts/update-symbols writes this list, and a test fails if the library exports anything else.

# A minor version may add fields to structs, for which linked programs must be compiled anew. So the minor version is part
# of the library's name: librelievo.so.1.0.
set(RELIEVO_SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})

set(RELIEVO_SYMBOLS ${PROJECT_SOURCE_DIR}/packaging/symbols.txt)
set(RELIEVO_VERSION_SCRIPT ${CMAKE_CURRENT_BINARY_DIR}/relievo.map)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${RELIEVO_SYMBOLS})
file(READ ${RELIEVO_SYMBOLS} symbols)
string(REGEX REPLACE "([^\n]+)\n" "    \"\\1\";\n" symbols "${symbols}")
file(CONFIGURE OUTPUT ${RELIEVO_VERSION_SCRIPT}
  CONTENT "LIBRELIEVO_${RELIEVO_SOVERSION} {\n  global: extern \"C++\" {\n${symbols}  };\n  local: *;\n};\n" @ONLY)

# Sets the name, the exported symbols and the version of a shared library.
function(relievo_shared_library target)
  set_target_properties(${target} PROPERTIES OUTPUT_NAME relievo VERSION ${PROJECT_VERSION} SOVERSION ${RELIEVO_SOVERSION}
    DEFINE_SYMBOL "" LINK_DEPENDS ${RELIEVO_VERSION_SCRIPT})
  target_link_options(${target} PRIVATE -Wl,--version-script=${RELIEVO_VERSION_SCRIPT} -Wl,-Bsymbolic-functions)
  if(NOT RELIEVO_SANITIZE)
    target_link_options(${target} PRIVATE -Wl,--no-undefined)
  endif()
endfunction()

if(BUILD_SHARED_LIBS)
  relievo_shared_library(relievo)
elseif(RELIEVO_BOTH_LIBRARIES)
  add_library(relievo_shared SHARED $<TARGET_OBJECTS:relievo>)
  target_link_libraries(relievo_shared INTERFACE Eigen3::Eigen PRIVATE ${RELIEVO_LINKED})
  target_compile_features(relievo_shared INTERFACE cxx_std_23)
  set_target_properties(relievo_shared PROPERTIES LINKER_LANGUAGE CXX EXPORT_NAME relievo)
  relievo_shared_library(relievo_shared)
endif()
