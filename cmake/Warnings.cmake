# Warnings of our own sources; errors when ARCWALL_WERROR is on.
add_library(arcwall_warnings INTERFACE)
target_compile_options(arcwall_warnings INTERFACE -Wall -Wextra -Wconversion -Wshadow $<$<BOOL:${ARCWALL_WERROR}>:-Werror>)
# g++ 12 sees overlapping copies in std::string's operator+ that are not there (GCC bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(arcwall_warnings INTERFACE -Wno-restrict)
endif()

# Sources that are compiled together look to g++ like headers, whose types had better not use unnamed namespaces; and what
# one of them names for itself is shadowed by the next, which only local names had better not be.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_UNITY_BUILD)
  target_compile_options(arcwall_warnings INTERFACE -Wno-subobject-linkage -Wno-shadow -Wshadow=local)
elseif(CMAKE_UNITY_BUILD)
  target_compile_options(arcwall_warnings INTERFACE -Wno-shadow)  # clang cannot look at local names alone
endif()

# Address and undefined-behaviour sanitizers, with assertions, for everything that is built here. Line tables are enough for
# their reports. The address sanitizer and the machine see null, misaligned, overflown and too distant accesses; checking for
# them before each access as well doubles the time to compile Eigen.
if(ARCWALL_SANITIZE)
  add_compile_options(-UNDEBUG -O2 -g1 -fsanitize=address,undefined
    -fno-sanitize=null,alignment,pointer-overflow,object-size -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

# What libFuzzer steers by is compiled into the libraries, so that fuzz targets and sanitized tests share them: which
# branches are taken. Tracing comparisons as well takes a third of the time, and the words of a deck are in a dictionary.
if(ARCWALL_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang" OR NOT ARCWALL_SANITIZE OR NOT ARCWALL_BUILD_APPS)
    message(FATAL_ERROR "ARCWALL_FUZZ needs clang (-DCMAKE_CXX_COMPILER=clang++), ARCWALL_SANITIZE and ARCWALL_BUILD_APPS")
  endif()
  add_compile_options(-fsanitize-coverage=inline-8bit-counters,pc-table)
endif()
