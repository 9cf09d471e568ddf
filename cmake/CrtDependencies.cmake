# This finds the outside libraries, all of which are packages of Debian 12.
find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_package(ZLIB REQUIRED)
find_package(EXPAT REQUIRED)
find_package(Freetype REQUIRED) # its headers alone: the library is loaded with the first font

# This takes Embree 4 if it is installed, else 3. src/core/accel/ compiles with both.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 REQUIRED)
endif()
message(STATUS "Embree ${embree_VERSION}")

find_package(OpenImageIO REQUIRED)
# Debian's OpenImageIO 2.4 names an include directory of OpenCV that does not exist.
get_target_property(oiio_includes OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
list(FILTER oiio_includes EXCLUDE REGEX opencv)
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
  INTERFACE_INCLUDE_DIRECTORIES "${oiio_includes}")

find_program(RE2C re2c REQUIRED)
find_package(BISON 3.8 REQUIRED)
