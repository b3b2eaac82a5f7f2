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
target_include_directories(softgrain_options INTERFACE ${PROJECT_SOURCE_DIR})
