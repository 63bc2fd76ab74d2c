# Finds the libraries that the project needs: those of the system or, for WebAssembly, those built by
# scripts/build-web-libraries. RELIEVO_LINKED lists the libraries to link.
if(NOT RELIEVO_WEB)
  find_package(Threads REQUIRED)
  find_package(Eigen3 3.4 REQUIRED NO_MODULE)
  find_package(nanoflann REQUIRED)
  find_package(nlohmann_json REQUIRED)
  find_package(TIFF REQUIRED)
  find_package(JPEG REQUIRED)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(SPNG REQUIRED IMPORTED_TARGET spng)
  pkg_check_modules(LIBLZF REQUIRED IMPORTED_TARGET liblzf)
  pkg_check_modules(LIBZIP REQUIRED IMPORTED_TARGET libzip)  # Debian's CMake file of libzip also needs its programs
  pkg_check_modules(HARFBUZZ REQUIRED IMPORTED_TARGET harfbuzz)
  pkg_check_modules(FRIBIDI REQUIRED IMPORTED_TARGET fribidi)
  set(RELIEVO_LINKED PkgConfig::SPNG TIFF::TIFF JPEG::JPEG PkgConfig::LIBLZF PkgConfig::LIBZIP Threads::Threads
    $<LINK_ONLY:PkgConfig::HARFBUZZ> $<LINK_ONLY:PkgConfig::FRIBIDI>)  # only src/lettering/font.cpp includes them
  return()
endif()

# Header-only libraries are those of the system. Their functions for C++ streams are left out: they would be half of the
# program.
function(relievo_headers target folder)
  add_library(${target} INTERFACE IMPORTED)
  target_include_directories(${target} SYSTEM INTERFACE ${folder})
endfunction()
relievo_headers(Eigen3::Eigen /usr/include/eigen3)
relievo_headers(nanoflann::nanoflann ${RELIEVO_WEB_LIBRARIES}/include)
relievo_headers(nlohmann_json::nlohmann_json ${RELIEVO_WEB_LIBRARIES}/include)
target_compile_definitions(Eigen3::Eigen INTERFACE EIGEN_NO_IO)
target_compile_definitions(nlohmann_json::nlohmann_json INTERFACE JSON_NO_IO)

function(relievo_web_library target name)
  add_library(${target} STATIC IMPORTED)
  set_target_properties(${target} PROPERTIES IMPORTED_LOCATION ${RELIEVO_WEB_LIBRARIES}/lib/lib${name}.a)
  target_include_directories(${target} SYSTEM INTERFACE ${RELIEVO_WEB_LIBRARIES}/include)
  target_link_libraries(${target} INTERFACE ${ARGN})
endfunction()
relievo_web_library(ZLIB::ZLIB z)
relievo_web_library(PkgConfig::SPNG spng ZLIB::ZLIB m)
relievo_web_library(TIFF::TIFF tiff ZLIB::ZLIB)
relievo_web_library(JPEG::JPEG jpeg)
relievo_web_library(PkgConfig::LIBLZF lzf)
relievo_web_library(PkgConfig::LIBZIP zip ZLIB::ZLIB)
relievo_web_library(PkgConfig::HARFBUZZ harfbuzz)
relievo_web_library(PkgConfig::FRIBIDI fribidi)
set(RELIEVO_LINKED PkgConfig::SPNG TIFF::TIFF JPEG::JPEG PkgConfig::LIBLZF PkgConfig::LIBZIP PkgConfig::HARFBUZZ
  PkgConfig::FRIBIDI)
