# crt_get_preload(out) returns what LD_PRELOAD must name for a program that is not built with the
# sanitizers of CRT_SANITIZE but loads a libcrt that is. It is empty without sanitizers. Their
# runtime must come first, and find the C++ library there.
function(crt_get_preload out)
  set(paths)
  if(CRT_SANITIZE MATCHES "address")
    set(runtime libasan.so)
  elseif(CRT_SANITIZE MATCHES "thread")
    set(runtime libtsan.so)
  endif()
  if(runtime)
    foreach(library ${runtime} libstdc++.so.6)
      execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=${library}
        OUTPUT_VARIABLE path OUTPUT_STRIP_TRAILING_WHITESPACE)
      list(APPEND paths ${path})
    endforeach()
  endif()
  list(JOIN paths ":" joined)
  set(${out} "${joined}" PARENT_SCOPE)
endfunction()
