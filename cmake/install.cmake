# Installs the library with its headers, and the program. All installed files find each other by relative paths, so an
# installed tree can be moved.

# As Meson does, installs libraries into Debian's own folder for libraries. Debian's linker, CMake and pkg-config search
# this folder under any prefix.
if(EXISTS /etc/debian_version AND CMAKE_LIBRARY_ARCHITECTURE AND NOT DEFINED CMAKE_INSTALL_LIBDIR)
  set(CMAKE_INSTALL_LIBDIR lib/${CMAKE_LIBRARY_ARCHITECTURE} CACHE PATH "Folder of libraries below the prefix")
endif()
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(RELIEVO_CMAKE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/relievo)

# relievo_install_library(TARGET static|shared) installs a library with the CMake file that exports it.
function(relievo_install_library target kind)
  set_property(TARGET ${target} APPEND PROPERTY
    INTERFACE_INCLUDE_DIRECTORIES $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  install(TARGETS ${target} EXPORT relievo_${kind}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
  install(EXPORT relievo_${kind} FILE relievo_${kind}.cmake NAMESPACE relievo:: DESTINATION ${RELIEVO_CMAKE_FOLDER}
    COMPONENT development)
endfunction()

# relievo_refuse_component(NAME REASON) makes `cmake --install --component NAME` fail. Otherwise it would silently
# install nothing.
function(relievo_refuse_component name reason)
  install(CODE "message(FATAL_ERROR \"expected a component that was built, found ${name}: ${reason}\")" COMPONENT ${name} EXCLUDE_FROM_ALL)
endfunction()

# Programs that link the static library must also link the libraries that it calls. Programs that link the shared
# library need not.
set(private_libraries "spng libtiff-4 libjpeg liblzf libzip harfbuzz fribidi")
if(BUILD_SHARED_LIBS)
  relievo_install_library(relievo shared)
else()
  relievo_install_library(relievo static)
  if(RELIEVO_BOTH_LIBRARIES)
    relievo_install_library(relievo_shared shared)
  else()
    relievo_refuse_component(library "configure with -DRELIEVO_BOTH_LIBRARIES=ON or -DBUILD_SHARED_LIBS=ON")
  endif()
endif()
if(BUILD_SHARED_LIBS OR RELIEVO_BOTH_LIBRARIES)
  set(RELIEVO_PC_REQUIRES "eigen3\nRequires.private: ${private_libraries}")
  set(RELIEVO_PC_LIBS "-lrelievo\nLibs.private: -pthread")
else()
  set(RELIEVO_PC_REQUIRES "eigen3 ${private_libraries}")
  set(RELIEVO_PC_LIBS "-lrelievo -pthread")
endif()

# Only the program and the tests use the samples, so their library is not installed.
install(DIRECTORY include/relievo DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
  FILES_MATCHING PATTERN "*.h" PATTERN samples EXCLUDE)

configure_package_config_file(packaging/relievoConfig.cmake.in relievoConfig.cmake
  INSTALL_DESTINATION ${RELIEVO_CMAKE_FOLDER} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(relievoConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/relievoConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/relievoConfigVersion.cmake
  DESTINATION ${RELIEVO_CMAKE_FOLDER} COMPONENT development)

file(RELATIVE_PATH RELIEVO_PC_PREFIX /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(packaging/relievo.pc.in relievo.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/relievo.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
  COMPONENT development)

# The program writes its own man pages and completion scripts.
if(RELIEVO_PROGRAM)
  set(share ${CMAKE_CURRENT_BINARY_DIR}/share)
  add_custom_command(OUTPUT ${share}/man/man1/relievo.1
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${share}
    COMMAND relievo_cli options --share ${share}
    DEPENDS relievo_cli VERBATIM)
  add_custom_target(relievo_share ALL DEPENDS ${share}/man/man1/relievo.1)

  install(TARGETS relievo_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  install(DIRECTORY ${share}/ DESTINATION ${CMAKE_INSTALL_DATAROOTDIR} COMPONENT program)
  install(FILES packaging/relievo.desktop DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/applications COMPONENT program)
  install(FILES packaging/relievo.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/metainfo COMPONENT program)
  install(FILES packaging/relievo.thumbnailer DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/thumbnailers COMPONENT program)
  install(FILES packaging/relievo.xml DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/mime/packages COMPONENT program)
  install(FILES apps/studio/page/icon.svg RENAME relievo.svg
    DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/icons/hicolor/scalable/apps COMPONENT program)
endif()
if(NOT RELIEVO_PROGRAM)
  relievo_refuse_component(program "configure with -DRELIEVO_PROGRAM=ON")
endif()
if(NOT TARGET relievo_python)
  relievo_refuse_component(python "configure with -DRELIEVO_PYTHON=ON, after scripts/prepare --python")
endif()
if(RELIEVO_PROGRAM AND RELIEVO_BOTH_LIBRARIES)
  include(cmake/debian_packages.cmake)
endif()
