# The headers that most sources of a target include are read once, and not for each source. Sources
# still include all that they use: presets without CRT_PRECOMPILE, such as `clang`, say whether.
option(CRT_PRECOMPILE "Read the headers that most sources include once" ${PROJECT_IS_TOP_LEVEL})

# crt_precompile(target header) has a target read a header before its sources.
function(crt_precompile target header)
  if(CRT_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${header})
  endif()
endfunction()

# crt_precompile_like(target other) has a target take what was read for another, which is compiled
# alike.
function(crt_precompile_like target other)
  if(CRT_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${other})
  endif()
endfunction()
