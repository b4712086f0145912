# SuiteSparse's CHOLMOD and UMFPACK, which come without a CMake configuration on Debian 12. Defines SuiteSparse::cholmod and
# SuiteSparse::umfpack.
find_path(SuiteSparse_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
foreach(library IN ITEMS cholmod umfpack)
  string(TOUPPER ${library} LIBRARY)
  find_library(SuiteSparse_${LIBRARY}_LIBRARY ${library})
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SuiteSparse REQUIRED_VARS SuiteSparse_INCLUDE_DIR SuiteSparse_CHOLMOD_LIBRARY
  SuiteSparse_UMFPACK_LIBRARY)

if(SuiteSparse_FOUND AND NOT TARGET SuiteSparse::cholmod)
  add_library(SuiteSparse::cholmod UNKNOWN IMPORTED)
  set_target_properties(SuiteSparse::cholmod PROPERTIES IMPORTED_LOCATION "${SuiteSparse_CHOLMOD_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${SuiteSparse_INCLUDE_DIR}")
  add_library(SuiteSparse::umfpack UNKNOWN IMPORTED)
  set_target_properties(SuiteSparse::umfpack PROPERTIES IMPORTED_LOCATION "${SuiteSparse_UMFPACK_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${SuiteSparse_INCLUDE_DIR}")
  target_link_libraries(SuiteSparse::umfpack INTERFACE SuiteSparse::cholmod)
endif()
