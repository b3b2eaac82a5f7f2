# softgrain_link_chord_variants(target): adds solve_chords_v2, _v3 and _v4, the batched chord compiled for one
# level of x86-64 each, to compare their bits and speed. Nothing on other processors.
function(softgrain_link_chord_variants target)
  if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    return()
  endif()
  foreach(level v2 v3 v4)
    set(library ${target}_chord_${level})
    add_library(${library} STATIC ${PROJECT_SOURCE_DIR}/sdem/geometry/chord_batch.cpp)
    target_include_directories(${library} PRIVATE ${PROJECT_SOURCE_DIR})
    target_compile_definitions(${library} PRIVATE solve_chords=solve_chords_${level} SOFTGRAIN_SIMD_LEVEL=0)
    target_compile_options(${library} PRIVATE -ffp-contract=off -fno-math-errno ${SOFTGRAIN_SIMD_FLAGS}
                                              -march=x86-64-${level})
    target_link_libraries(${target} PRIVATE ${library})
  endforeach()
  target_compile_definitions(${target} PRIVATE SOFTGRAIN_CHORD_VARIANTS)
endfunction()
