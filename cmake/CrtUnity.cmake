# With CMAKE_UNITY_BUILD sources of one folder are compiled as one: all of them for the linter and
# for the build with sanitizers, or as many as CMAKE_UNITY_BUILD_BATCH_SIZE says. A header is then
# read once for these and not once a source. So no two sources of a folder may give one name to
# different things (tests/house/twins.awk finds what compilers do not). A variable may hide a name
# of another source, but not a variable about it.
target_compile_options(crt_compile INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-shadow>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC takes sources that are included for headers, which must have no unnamed namespaces.
  target_compile_options(crt_compile INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage;-Wshadow=local>)
endif()

foreach(target crt_core crt_lang crt_farm crt_capi_objects crt_format crt_service crt_source
  crt_import crt_lsp crt_trade crt_studio crt)
  if(NOT TARGET ${target})
    continue()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder_of_target ${target} SOURCE_DIR)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder_of_target})
    cmake_path(IS_PREFIX PROJECT_BINARY_DIR ${source} is_generated)
    if(is_generated)
      continue() # it is compiled alone
    endif()
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    string(MAKE_C_IDENTIFIER "${folder}" group)
    if(CMAKE_UNITY_BUILD_BATCH_SIZE)
      math(EXPR number_of_${group} "${number_of_${group}} + 1")
      math(EXPR batch "(${number_of_${group}} - 1) / ${CMAKE_UNITY_BUILD_BATCH_SIZE}")
      string(APPEND group "_${batch}")
    endif()
    set_source_files_properties(${source} TARGET_DIRECTORY ${target}
      PROPERTIES UNITY_GROUP ${group})
  endforeach()
endforeach()
