# One interface target carries the flags of every granvof target.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3")

if(GRANVOF_CCACHE)
  find_program(CCACHE_PROGRAM ccache)
  if(CCACHE_PROGRAM)
    set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  endif()
endif()

add_library(granvof_options INTERFACE)
target_compile_options(granvof_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  # Neither errno nor floating-point traps are read anywhere; without these flags sqrt and selects do not vectorise.
  -fno-math-errno -fno-trapping-math)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 raises these two falsely, in the vector intrinsics under Eigen and inside fmt.
  target_compile_options(granvof_options INTERFACE -Wno-maybe-uninitialized -Wno-stringop-overflow)
endif()
if(GRANVOF_NATIVE)
  target_compile_options(granvof_options INTERFACE -march=native)
  if(CCACHE_PROGRAM)
    # ccache takes `native` as a word: name the instruction set, so that no other machine's objects are reused.
    execute_process(COMMAND ${CMAKE_CXX_COMPILER} -march=native -Q --help=target
      OUTPUT_VARIABLE native_target ERROR_QUIET)
    string(SHA1 native_target "${native_target}")
    target_compile_definitions(granvof_options INTERFACE GRANVOF_NATIVE_TARGET=0x${native_target})
  endif()
endif()
if(GRANVOF_WERROR)
  target_compile_options(granvof_options INTERFACE -Werror)
endif()
if(GRANVOF_SANITIZE)
  # Fast enough to run the scenes' tests; Eigen's and the standard library's own checks are on as well.
  target_compile_options(granvof_options INTERFACE -O1 -g1
    -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_compile_definitions(granvof_options INTERFACE _GLIBCXX_ASSERTIONS)
  target_link_options(granvof_options INTERFACE -fsanitize=address,undefined)
endif()
if(GRANVOF_FUZZ)
  target_compile_options(granvof_options INTERFACE -O1 -g1
    -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(granvof_options INTERFACE -fsanitize=address,undefined)
endif()
target_include_directories(granvof_options INTERFACE ${CMAKE_SOURCE_DIR})
