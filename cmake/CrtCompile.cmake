# The interface target crt_compile says how every target of the project is compiled.
add_library(crt_compile INTERFACE)
target_compile_features(crt_compile INTERFACE cxx_std_20)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

target_compile_options(crt_compile INTERFACE -Wall -Wextra -Wconversion -Wshadow)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 sees overlaps in "text" + std::string where there are none (its bug 105651).
  target_compile_options(crt_compile INTERFACE -Wno-restrict)
endif()
if(CRT_WERROR)
  target_compile_options(crt_compile INTERFACE -Werror)
endif()

# The compiler must not fuse a * b + c on its own: results would depend on it. Every fma is written.
target_compile_options(crt_compile INTERFACE -ffp-contract=off)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  include(CrtInstructions)
endif()

if(CRT_SANITIZE)
  target_compile_options(crt_compile INTERFACE
    -fsanitize=${CRT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -g)
  target_link_options(crt_compile INTERFACE -fsanitize=${CRT_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # With what sanitizers add, GCC 12 does not see that an empty std::optional's content is never
    # read.
    target_compile_options(crt_compile INTERFACE -Wno-maybe-uninitialized)
  endif()
endif()
if(CRT_COVERAGE)
  target_compile_options(crt_compile INTERFACE --coverage -g -O0)
  target_link_options(crt_compile INTERFACE --coverage)
endif()

# Compiled objects are cached where there is a cache, but not where the caller has chosen a
# launcher.
if(PROJECT_IS_TOP_LEVEL AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(CCACHE ccache)
  if(CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
  endif()
endif()
