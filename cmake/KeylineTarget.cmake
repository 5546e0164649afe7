# What every target of the project is compiled with.
#
# -ffp-contract=off: a fused multiply-add rounds once where the formula rounds twice, and whether the compiler
# fuses depends on the target; pixels may not.

add_library(keyline_options INTERFACE)
target_compile_features(keyline_options INTERFACE cxx_std_20)
target_compile_options(keyline_options INTERFACE
  -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)
target_include_directories(keyline_options INTERFACE ${PROJECT_SOURCE_DIR})
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # g++ 12 sees uninitialised strings and variants where there are none (GCC bug 105562), and copies within strings
  # that overlap or leave them (GCC bugs 105651, 105329).  The sanitizers and clang, which CI runs, see real ones.
  target_compile_options(keyline_options INTERFACE
    -Wno-maybe-uninitialized -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow)
endif()
if(KEYLINE_SANITIZE)
  string(REPLACE ";" "," _sanitizers "${KEYLINE_SANITIZE}")
  target_compile_options(keyline_options INTERFACE
    -fsanitize=${_sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(keyline_options INTERFACE -fsanitize=${_sanitizers})
endif()

set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# keyline_not_hot(TARGET): it is compiled for a quick build and not for speed, also where the rest of a debug build is
# optimised; what computes pixels lies in the library.
function(keyline_not_hot target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release,RelWithDebInfo>:-O1> $<$<CONFIG:Debug>:-O0>)
endfunction()
