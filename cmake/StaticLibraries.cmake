# Libraries inside trace-path in place of shared ones, which take longer to load than a small run takes. Only the program
# has them inside: a target whose property ARCWALL_CARRIES_LIBRARIES is on. The Python module and programs that use the
# libraries of arcwall share those of the system.
#
# libraries_of(VARIABLE name…): what a library of arcwall is linked with for these: SuiteSparse, program_options,
# pugixml, zlib.
set(static_parts umfpack cholmod ccolamd camd colamd amd suitesparseconfig boost_program_options pugixml z)
set(static_parts_are_there ON)
foreach(part IN LISTS static_parts)
  find_library(ARCWALL_STATIC_${part} lib${part}.a)
  mark_as_advanced(ARCWALL_STATIC_${part})
  if(NOT ARCWALL_STATIC_${part})
    set(static_parts_are_there OFF)
  endif()
endforeach()
if(NOT EXISTS /etc/debian_version OR ARCWALL_SANITIZE)
  set(static_parts_are_there OFF)
endif()
option(ARCWALL_STATIC_LIBRARIES "Put SuiteSparse, Boost, pugixml, zlib and the C++ library into trace-path"
  ${static_parts_are_there})

set(static_of_suitesparse umfpack cholmod ccolamd camd colamd amd suitesparseconfig)
set(static_of_program_options boost_program_options)
set(static_of_pugixml pugixml)
set(static_of_zlib z)
set(shared_of_suitesparse SuiteSparse::cholmod SuiteSparse::umfpack)
set(shared_of_program_options Boost::program_options)
set(shared_of_pugixml pugixml::pugixml)
set(shared_of_zlib ZLIB::ZLIB)
function(libraries_of result)
  set(carries $<BOOL:$<TARGET_PROPERTY:ARCWALL_CARRIES_LIBRARIES>>)
  set(all "")
  foreach(name IN LISTS ARGN)
    foreach(part IN LISTS static_of_${name})
      list(APPEND all $<BUILD_INTERFACE:$<${carries}:${ARCWALL_STATIC_${part}}>>)
    endforeach()
    foreach(part IN LISTS shared_of_${name})
      list(APPEND all $<BUILD_INTERFACE:$<$<NOT:${carries}>:${part}>> $<INSTALL_INTERFACE:${part}>)
    endforeach()
  endforeach()
  set(${result} ${all} PARENT_SCOPE)
endfunction()
