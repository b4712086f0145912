# optimize_target(TARGET level): the level of Release in place of CMake's -O3, where that compiles longer and runs no faster.
function(optimize_target target level)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${level}>)
endfunction()

# arcwall_library(NAME name SOURCES … HEADERS …): one of the libraries of the star. Headers keep their folder below
# the include root, in the build tree and installed: <arcwall/core/system.hpp> for users, "core/system.hpp" inside.
# TOGETHER: how many sources a unity build compiles at a time. Each unit reads the headers and makes Eigen's templates anew:
# two units a library, of about equal cost, take less time than four. OPTIMIZE: see optimize_target.
function(arcwall_library)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "" "NAME;OPTIMIZE;TOGETHER" "SOURCES;HEADERS")
  set(target arcwall_${ARG_NAME})
  add_library(${target})
  add_library(arcwall::${ARG_NAME} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${ARG_NAME} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # Nothing reads errno after a square root; to set it costs a branch and a call.
  target_compile_options(${target} PRIVATE -fno-math-errno)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE ${ARG_TOGETHER})
  list(LENGTH ARG_SOURCES count)
  math(EXPR most "2 * ${ARG_TOGETHER} + 1")  # one may be compiled alone
  if(CMAKE_UNITY_BUILD AND count GREATER most)
    message(FATAL_ERROR "${target} has ${count} sources, more than two units of ${ARG_TOGETHER}: set TOGETHER to half of them")
  endif()
  if(DEFINED ARG_OPTIMIZE)
    optimize_target(${target} ${ARG_OPTIMIZE})
  endif()
  target_sources(${target} PRIVATE ${ARG_SOURCES}
    PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${ARG_HEADERS})
  target_include_directories(${target} INTERFACE
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/arcwall>)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:arcwall_warnings>)
  install(TARGETS ${target} EXPORT arcwallTargets COMPONENT development
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/arcwall COMPONENT development)
endfunction()
