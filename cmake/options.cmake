# Flags that every target of this project takes through softgrain_options.
add_library(softgrain_options INTERFACE)
# No fused multiply-add: the same source gives the same bits on every path through it.
target_compile_options(softgrain_options INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
                                                   -ffp-contract=off -fno-math-errno)
if(SOFTGRAIN_WERROR)
  target_compile_options(softgrain_options INTERFACE -Werror)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 warns so of std::string's own assignment (GCC bug 105329) and of its own AVX-512 headers (105593).
  target_compile_options(softgrain_options INTERFACE -Wno-restrict -Wno-maybe-uninitialized -Wno-uninitialized)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  # Of a loop that stays scalar, and of `a & b ? c : d`.
  target_compile_options(softgrain_options INTERFACE -Wno-pass-failed -Wno-bitwise-conditional-parentheses)
  if(CMAKE_UNITY_BUILD)
    target_compile_options(softgrain_options INTERFACE -Wno-shadow) # of a name in another file
  endif()
endif()
if(SOFTGRAIN_NATIVE)
  target_compile_options(softgrain_options INTERFACE -march=native)
endif()
if(SOFTGRAIN_SANITIZE)
  # GCC's instrumentation makes it warn of variables that are set (see its manual, -fsanitize).
  target_compile_options(softgrain_options INTERFACE -Wno-maybe-uninitialized)
  target_compile_options(softgrain_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
                                                     -fno-omit-frame-pointer -D_GLIBCXX_ASSERTIONS)
  target_link_options(softgrain_options INTERFACE -fsanitize=address,undefined)
endif()
if(SOFTGRAIN_SANITIZE_THREADS)
  target_compile_options(softgrain_options INTERFACE -fsanitize=thread -fno-omit-frame-pointer)
  target_link_options(softgrain_options INTERFACE -fsanitize=thread)
endif()
if(SOFTGRAIN_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "SOFTGRAIN_FUZZ needs clang: cmake --preset fuzz")
  endif()
  target_compile_options(softgrain_options INTERFACE -fsanitize=fuzzer-no-link,address,undefined
                                                     -fno-sanitize-recover=all -D_GLIBCXX_ASSERTIONS)
  target_link_options(softgrain_options INTERFACE -fsanitize=address,undefined)
endif()
if(SOFTGRAIN_HARDENING AND CMAKE_BUILD_TYPE STREQUAL "Release")
  # Not -fPIC, which CMake would take for libraries: it keeps functions from being inlined.
  target_compile_options(softgrain_options INTERFACE -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2 -fstack-protector-strong -fPIE)
  target_link_options(softgrain_options INTERFACE -pie -Wl,-z,relro,-z,now)
endif()
target_include_directories(softgrain_options INTERFACE ${PROJECT_SOURCE_DIR})

# softgrain_compile_together(targets...): several source files of them at a time, which takes about half of the time. For what is not
# hot; debug builds, which editors ask, keep files apart.
function(softgrain_compile_together)
  if(NOT CMAKE_BUILD_TYPE STREQUAL "Debug")
    set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ON)
  endif()
endfunction()
