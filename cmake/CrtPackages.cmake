# CPack makes the Debian packages libcrt1, libcrt-dev, crt and crt-studio, a component each (see
# CrtInstall.cmake). `./dev package` makes them of the release build, whose prefix is /usr.
set(runtime_package libcrt${PROJECT_VERSION_MAJOR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME crt)
set(CPACK_PACKAGE_CONTACT "The CRT authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_COMPONENTS_ALL runtime development command)
if(TARGET crt-studio)
  list(APPEND CPACK_COMPONENTS_ALL studio)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS runtime)
set(CPACK_COMPONENT_COMMAND_DEPENDS runtime)
set(CPACK_COMPONENT_STUDIO_DEPENDS runtime command)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# A program that is built with this version needs it or a later one.
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# Every description ends with this.
set(about "CRT renders solids that are described by their equations (spheres, boxes,
cylinders, cones, capsules, tori, quadrics, half-spaces, extruded and revolved profiles,
added, subtracted and intersected) without cutting them into triangles.")

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ${runtime_package})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
# This says what the library depends on, and what it only recommends.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS OFF)
set(CPACK_CRT_LIBRARIES ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/CrtRuntimePackage.cmake)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "ray tracer of analytic solids: library with a C interface
${about}
.
This package has libcrt.so.${PROJECT_VERSION_MAJOR}, which programs use, and its
module for image files.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libcrt-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS
  "libglm-dev, libtbb-dev, libembree-dev, zlib1g-dev, libexpat1-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "ray tracer of analytic solids: development files
${about}
.
This package has what programs are built with: the C header and libcrt.so; and
the C++ headers and static libraries, which need the recommended packages.")

set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME crt)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS "ffmpeg")
set(CPACK_COMPONENT_COMMAND_DESCRIPTION "ray tracer of analytic solids: command line
${about}
.
This package has the command crt, which renders scenes written in CRT's own
small language to image files.")

set(CPACK_DEBIAN_STUDIO_PACKAGE_NAME crt-studio)
set(CPACK_DEBIAN_STUDIO_PACKAGE_SECTION graphics)
set(CPACK_COMPONENT_STUDIO_DESCRIPTION "ray tracer of analytic solids: studio
${about}
.
This package has what the command crt studio starts: a server for a page in a
browser, to write a scene and to see its picture meanwhile.")

file(READ ${PROJECT_SOURCE_DIR}/share/fonts/LICENSE.Liberation font_licence)
file(READ ${PROJECT_SOURCE_DIR}/src/studio/page/dist/licenses.txt page_licences)
# Each Debian package has a file with its licence. Only Debian wants it.
file(WRITE ${PROJECT_BINARY_DIR}/package/copyright
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: crt

Files: *
Copyright: The CRT authors
License: Apache-2.0
 On Debian systems the text of the Apache License, version 2.0, is in
 /usr/share/common-licenses/Apache-2.0.

The libraries hold the font Liberation Sans, for which this is said:

${font_licence}

The studio's page holds these packages of npm:

${page_licences}")
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} name)
  install(FILES ${PROJECT_BINARY_DIR}/package/copyright
    DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${CPACK_DEBIAN_${name}_PACKAGE_NAME}
    COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()

include(CPack)
