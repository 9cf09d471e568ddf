# This chooses which instructions of x86-64 the compiler may use. Results are the same with all.
set(CRT_ISA "avx2" CACHE STRING
  "Instructions of x86-64 to use: baseline (every such processor has them), avx2, or avx512")
set_property(CACHE CRT_ISA PROPERTY STRINGS baseline avx2 avx512)

if(CRT_ISA STREQUAL "baseline")
  set(isa_level x86-64)
elseif(CRT_ISA STREQUAL "avx2")
  set(isa_level x86-64-v3) # with FMA
elseif(CRT_ISA STREQUAL "avx512")
  set(isa_level x86-64-v4)
else()
  message(FATAL_ERROR "CRT_ISA is '${CRT_ISA}', but must be baseline, avx2 or avx512")
endif()
target_compile_options(crt_compile INTERFACE -march=${isa_level})

# The dynamic loader reads this mark. On a lesser processor it says what is missing, where the
# program would end by an illegal instruction.
if(NOT CRT_ISA STREQUAL "baseline")
  include(CheckLinkerFlag)
  check_linker_flag(CXX "LINKER:-z,${isa_level}" CRT_LINKER_MARKS_ISA)
  if(CRT_LINKER_MARKS_ISA)
    target_link_options(crt_compile INTERFACE "LINKER:-z,${isa_level}")
  endif()
endif()
