# Makes full builds faster: headers that most sources include are precompiled, and several sources of a folder are
# compiled together as one (CMake's unity build). Without RELIEVO_UNITY each source is compiled by itself, which is
# faster after a small change and shows all warnings.
option(RELIEVO_UNITY "Compile the sources of a folder together" ON)

# Turns off false alarms of g++ 12 in code with a precompiled <string>. Programs and tests use these flags.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(RELIEVO_FALSE_ALARMS -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
endif()

# relievo_precompile(TARGET HEADER...) precompiles cmake/precompiled.h and the given headers for the target;
# relievo_precompile(TARGET REUSE_FROM OTHER) uses the precompiled headers of another target with the same options.
function(relievo_precompile target)
  if(ARGV1 STREQUAL REUSE_FROM)
    target_precompile_headers(${target} REUSE_FROM ${ARGV2})
  else()
    target_precompile_headers(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled.h ${ARGN})
  endif()
endfunction()

# relievo_unite(TARGET SIZE) compiles the target's sources in groups of at most SIZE from one folder.
function(relievo_unite target size)
  if(NOT RELIEVO_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # These two warnings confuse names in the unnamed namespaces of two sources. They are on in builds without unity.
  target_compile_options(${target} PRIVATE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  get_target_property(sources ${target} SOURCES)
  set(group 0)
  set(in_group 0)
  set(last_folder "")
  foreach(source IN LISTS sources)
    get_filename_component(folder ${source} DIRECTORY)
    if(in_group EQUAL size OR NOT folder STREQUAL last_folder)
      math(EXPR group "${group} + 1")
      set(in_group 0)
    endif()
    math(EXPR in_group "${in_group} + 1")
    set(last_folder ${folder})
    get_filename_component(room ${folder} NAME)
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${room}_${group})
  endforeach()
endfunction()

# Applies relievo_precompile() and relievo_unite() to a target. The other arguments are those of relievo_precompile().
function(relievo_fast_build target)
  relievo_precompile(${target} ${ARGN})
  if(RELIEVO_WEB)
    relievo_unite(${target} 8)  # another division of the sources into two targets, see small_rooms.cmake
  else()
    relievo_unite(${target} 16)
  endif()
endfunction()
