# What is built. Every part is on where CRT is the top of the build, and off where CRT is a part of
# another project, unless that asks for it. A part needs others, which come along with it; where one
# of those is switched off, so is the part, unless it is asked for: that is an error.
#
# crt_part(OPTION text NEEDS option...) says so. A part stands behind those that it needs.
set(crt_parts)
macro(crt_part part text)
  cmake_parse_arguments(crt_part "" "" "NEEDS" ${ARGN})
  list(APPEND crt_parts ${part})
  set(${part}_text "${text}")
  set(${part}_needs ${crt_part_NEEDS})
endmacro()

crt_part(CRT_WITH_IMAGES "Read and write image files, by OpenImageIO, and pack PNG files, by zlib")
crt_part(CRT_WITH_FONTS "Make contours of text, by FreeType")
crt_part(CRT_WITH_MESH_FILES "Read mesh files, by zlib and Expat")
crt_part(CRT_WITH_LANG "Run scripts: crt::lang; Bison and re2c make it")
crt_part(CRT_WITH_SOURCE "Write scenes as source code: crt::source")
crt_part(CRT_WITH_FARM "Render on many machines: crt::farm; needs nlohmann_json"
  NEEDS CRT_WITH_LANG)
crt_part(CRT_WITH_SERVICE "Tell editors about scripts: crt::service" NEEDS CRT_WITH_LANG)
set(tested ${crt_parts})
crt_part(CRT_WITH_STUDIO "Show scenes in a browser: crt::studio; needs Boost and nlohmann_json"
  NEEDS CRT_WITH_LANG CRT_WITH_SOURCE CRT_WITH_SERVICE)
crt_part(CRT_BUILD_CLI "Build the command crt"
  NEEDS CRT_WITH_LANG CRT_WITH_SOURCE CRT_WITH_FARM CRT_WITH_SERVICE)
crt_part(CRT_BUILD_TESTS "Build the tests" NEEDS ${tested})
crt_part(CRT_BUILD_EXAMPLES "Build the example programs" NEEDS ${tested})
crt_part(CRT_BUILD_PYTHON "Build what a Python wheel needs beside libcrt.so")
crt_part(CRT_INSTALL "Have rules to install CRT")

# What is asked for brings what it needs.
list(REVERSE crt_parts)
foreach(part IN LISTS crt_parts)
  if(${part} OR ${part}_is_needed)
    foreach(needed IN LISTS ${part}_needs)
      set(${needed}_is_needed ON)
    endforeach()
  endif()
endforeach()

list(REVERSE crt_parts)
foreach(part IN LISTS crt_parts)
  set(default ${PROJECT_IS_TOP_LEVEL})
  if(${part}_is_needed)
    set(default ON)
  endif()
  foreach(needed IN LISTS ${part}_needs)
    if(NOT ${needed})
      set(default OFF)
    endif()
  endforeach()
  option(${part} "${${part}_text}" ${default})
  foreach(needed IN LISTS ${part}_needs)
    if(${part} AND NOT ${needed})
      message(FATAL_ERROR "${part} is ON, and needs ${needed}, which is OFF")
    endif()
  endforeach()
endforeach()
