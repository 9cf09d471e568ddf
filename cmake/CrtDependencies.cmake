# This finds the outside libraries, all of which are packages of Debian 12.

# crt_find(OPTION DEBIAN_PACKAGE package...) finds a package as find_package does. Where there is
# none, it says which option needs it.
macro(crt_find option debian package)
  find_package(${package} ${ARGN})
  if(NOT ${package}_FOUND)
    message(FATAL_ERROR "${package} is not found (Debian has it as ${debian}), and "
      "${option} needs it: install it, or configure with -D${option}=OFF")
  endif()
endmacro()

# The renderer needs these and nothing else.
find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(TBB REQUIRED)
# This takes Embree 4 if it is installed, else 3. src/core/accel/ compiles with both.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 REQUIRED)
endif()
message(STATUS "Embree ${embree_VERSION}")

if(CRT_WITH_IMAGES)
  crt_find(CRT_WITH_IMAGES zlib1g-dev ZLIB)
  crt_find(CRT_WITH_IMAGES "libopenimageio-dev and openimageio-tools" OpenImageIO)
  # Debian's OpenImageIO 2.4 names an include directory of OpenCV that does not exist.
  get_target_property(oiio_includes OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
  list(FILTER oiio_includes EXCLUDE REGEX opencv)
  set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${oiio_includes}")
endif()
if(CRT_WITH_MESH_FILES)
  crt_find(CRT_WITH_MESH_FILES zlib1g-dev ZLIB)
  crt_find(CRT_WITH_MESH_FILES libexpat1-dev EXPAT)
endif()
if(CRT_WITH_FONTS)
  # The headers alone are used: the library is loaded with the first font.
  crt_find(CRT_WITH_FONTS libfreetype-dev Freetype)
endif()
if(CRT_WITH_LANG)
  find_program(RE2C re2c)
  if(NOT RE2C)
    message(FATAL_ERROR "re2c is not found, and CRT_WITH_LANG needs it: install it, or configure "
      "with -DCRT_WITH_LANG=OFF")
  endif()
  crt_find(CRT_WITH_LANG bison BISON 3.8)
endif()
foreach(option CRT_WITH_FARM CRT_WITH_STUDIO CRT_BUILD_CLI CRT_BUILD_TESTS)
  if(${option})
    crt_find(${option} nlohmann-json3-dev nlohmann_json 3.11)
  endif()
endforeach()
if(CRT_WITH_STUDIO)
  crt_find(CRT_WITH_STUDIO libboost-dev Boost 1.74)
endif()
if(CRT_BUILD_CLI)
  crt_find(CRT_BUILD_CLI libcli11-dev CLI11)
endif()
foreach(option CRT_BUILD_CLI CRT_BUILD_TESTS)
  if(${option})
    crt_find(${option} libfmt-dev fmt)
  endif()
endforeach()
