# CPack reads this before it makes packages. The package of the library depends on what libcrt.so
# links. It only recommends what is loaded when it is first needed: what the module for image files
# links, OpenImageIO above all, and FreeType. dpkg-shlibdeps says which packages those are.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()
find_program(SHLIBDEPS_EXECUTABLE dpkg-shlibdeps REQUIRED)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS libfreetype6) # which dpkg-shlibdeps cannot see
set(linked)
if(EXISTS ${CPACK_CRT_LIBRARIES}/libcrt.so)
  list(APPEND linked -dDepends ${CPACK_CRT_LIBRARIES}/libcrt.so)
endif()
if(EXISTS ${CPACK_CRT_LIBRARIES}/crt/crt_image_files.so)
  list(APPEND linked -dRecommends ${CPACK_CRT_LIBRARIES}/crt/crt_image_files.so)
endif()

if(NOT linked)
  return()
endif()
# It wants to be where a package is made.
set(folder ${CPACK_CRT_LIBRARIES}/../package/shlibdeps)
file(MAKE_DIRECTORY ${folder}/debian)
file(WRITE ${folder}/debian/control "")
execute_process(COMMAND ${SHLIBDEPS_EXECUTABLE} --ignore-missing-info -O ${linked}
  WORKING_DIRECTORY ${folder} OUTPUT_VARIABLE answer ERROR_VARIABLE complaint
  RESULT_VARIABLE failure)
if(failure)
  message(FATAL_ERROR "dpkg-shlibdeps: ${complaint}")
endif()
if(answer MATCHES "shlibs:Depends=([^\n]*)")
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "${CMAKE_MATCH_1}")
endif()
if(answer MATCHES "shlibs:Recommends=([^\n]*)")
  string(APPEND CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS ", ${CMAKE_MATCH_1}")
endif()
