# For the web, only the rooms that take most of the computing time are optimised for speed. All other rooms (files,
# plates and measures) are optimised for size, and so are sources of the fast rooms that run only once per scan. The
# sources optimised for size form their own target, whose objects are part of the library.
set(RELIEVO_PRECOMPILED relievo)
if(NOT RELIEVO_WEB)
  return()
endif()

get_target_property(small_sources relievo SOURCES)
list(FILTER small_sources EXCLUDE REGEX "/src/(core|geometry|scan|solver|relief|relief/correction|picture)/[^/]*$")
get_target_property(fast_sources relievo SOURCES)
set(brief_sources ${fast_sources})
set(brief "core/(json_place|length|text)" "geometry/(convex_polygon|fair_curve|held_edges|outline_union|raised_shape|slope_limit|smooth_surface|weld)"
    "picture/(body|height_map|live_plate|plate_mesh|preview|reach_tint)" "relief/(draft|method|nearest_draft|relief|step_heights|tone_curve)"
    "scan/(boundary|depth_cloud|depth_grid|depth_smooth|front_mesh|jumps|measured_cloud|resample|support_plane|surface)"
    "scan/(picture_cloud|scanned_side|view|view_ranking|viewed_cloud)" "solver/(supernodes|task_tree)")
list(JOIN brief "|" brief)
list(FILTER brief_sources INCLUDE REGEX "/(${brief})[.]cpp$")
list(APPEND small_sources ${brief_sources})
list(REMOVE_ITEM fast_sources ${small_sources})
set_target_properties(relievo PROPERTIES SOURCES "${fast_sources}")

add_library(relievo_small OBJECT ${small_sources})
target_include_directories(relievo_small PRIVATE include src)
target_link_libraries(relievo_small PRIVATE Eigen3::Eigen ${RELIEVO_LINKED} nanoflann::nanoflann nlohmann_json::nlohmann_json)
target_compile_options(relievo_small PRIVATE -Oz)
relievo_compiler_options(relievo_small)
relievo_fast_build(relievo_small)
target_link_libraries(relievo PRIVATE relievo_small)
set(RELIEVO_PRECOMPILED relievo_small)

# Only this source calls setjmp() and longjmp(), which need special instructions.
set_source_files_properties(src/io/pictures/depth_jpeg.cpp PROPERTIES
  COMPILE_OPTIONS "-mllvm;-wasm-enable-sjlj" INCLUDE_DIRECTORIES ${PROJECT_SOURCE_DIR}/apps/web/libc
  SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
