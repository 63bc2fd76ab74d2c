# Makes Debian packages with CPack: relievo (the program), librelievo1.0 (the shared library), librelievo-dev (headers,
# static library, CMake and pkg-config files) and, if the Python module is built, python3-relievo. The command is `cpack
# --config build/release/CPackConfig.cmake -B FOLDER`.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME relievo)
set(CPACK_PACKAGE_VENDOR Relievo)
set(CPACK_PACKAGE_CONTACT "Relievo maintainers <maintainers@relievo.example>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_COMPONENTS_ALL program library development)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/packaging/finish_debian_tree.cmake)
set(CPACK_RELIEVO_SOURCE ${PROJECT_SOURCE_DIR})

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS OFF)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME relievo)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS xdg-utils)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "turn 3D scans into bas-reliefs
Relievo makes a bas-relief of a point cloud, a mesh or a depth image: a
watertight solid of exactly the height asked for, to be printed, milled or
struck. The studio shapes it by hand, live, in the browser.")

set(library_package librelievo${RELIEVO_SOVERSION})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${library_package})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/triggers)
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "bas-reliefs from 3D scans - shared library
Relievo makes a bas-relief of a point cloud, a mesh or a depth image. This is
the library that programs are linked with.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME librelievo-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${library_package} (= ${PROJECT_VERSION}), libeigen3-dev (>= 3.4), \
libspng-dev, libtiff-dev, libjpeg62-turbo-dev, liblzf-dev, libzip-dev, libharfbuzz-dev, libfribidi-dev, libbz2-dev, \
libssl-dev")  # the last two for static libzip
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "bas-reliefs from 3D scans - headers and static library
Relievo makes a bas-relief of a point cloud, a mesh or a depth image. With this
package C++ programs are built that call it, by CMake or pkg-config.")

if(TARGET relievo_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  # The module works only with one version of Python 3.
  get_target_property(suffix relievo_python SUFFIX)
  string(REGEX MATCH "cpython-3([0-9]+)" suffix ${suffix})
  math(EXPR next "${CMAKE_MATCH_1} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-relievo)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${CMAKE_MATCH_1}), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS relievo)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS python3-distributed)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/python/postinst
    ${PROJECT_SOURCE_DIR}/packaging/python/prerm)
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "bas-reliefs from 3D scans - Python package
Relievo makes a bas-relief of a point cloud, a mesh or a depth image. This is
its package for Python: files or arrays in, solids and height maps out.")
endif()

include(CPack)
