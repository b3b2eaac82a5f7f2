# Functions marked SOFTGRAIN_CLONES (common/simd.hpp) are compiled for several instruction sets.
set(SOFTGRAIN_SIMD auto CACHE STRING "Newest instruction set of marked functions: auto (AVX-512), avx2 or none")
set_property(CACHE SOFTGRAIN_SIMD PROPERTY STRINGS auto avx2 none)
set(SOFTGRAIN_SIMD_LEVEL_auto 2)
set(SOFTGRAIN_SIMD_LEVEL_avx2 1)
set(SOFTGRAIN_SIMD_LEVEL_none 0)
if(NOT DEFINED SOFTGRAIN_SIMD_LEVEL_${SOFTGRAIN_SIMD})
  message(FATAL_ERROR "SOFTGRAIN_SIMD must be auto, avx2 or none, got ${SOFTGRAIN_SIMD}")
endif()
if(SOFTGRAIN_SANITIZE OR SOFTGRAIN_SANITIZE_THREADS OR SOFTGRAIN_FUZZ)
  set(SOFTGRAIN_SIMD_LEVEL 0) # address sanitizer and run-time dispatch do not agree
else()
  set(SOFTGRAIN_SIMD_LEVEL ${SOFTGRAIN_SIMD_LEVEL_${SOFTGRAIN_SIMD}})
endif()
target_compile_definitions(softgrain_options INTERFACE SOFTGRAIN_SIMD_LEVEL=${SOFTGRAIN_SIMD_LEVEL})

set(SOFTGRAIN_SIMD_FLAGS -fopenmp-simd -fno-trapping-math)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND SOFTGRAIN_SIMD_FLAGS -mprefer-vector-width=512 -march=x86-64)
endif()

if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  list(APPEND SOFTGRAIN_SIMD_FLAGS -Wno-psabi) # vectors are passed to inlined functions only
endif()

# softgrain_simd_sources(files...): their loops become vectors, for the processor found when the program
# starts and not for the one it is built on. They must not include Eigen, whose layout follows -march.
function(softgrain_simd_sources)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${SOFTGRAIN_SIMD_FLAGS}")
endfunction()
