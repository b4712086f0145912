# SuiteSparse's CHOLMOD and UMFPACK, which come without a CMake configuration on Debian 12, and the LAPACK they need.
# Defines SuiteSparse::cholmod and SuiteSparse::umfpack.
#
# With SuiteSparse_LATE_BLAS, the name of a target that has what they call of BLAS, LAPACK, METIS and OpenMP, they are the
# archives, and no library is loaded before it is needed.
find_path(SuiteSparse_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
set(SuiteSparse_LIBRARIES UMFPACK CHOLMOD AMD COLAMD CCOLAMD CAMD SUITESPARSECONFIG)
set(SuiteSparse_REQUIRED SuiteSparse_INCLUDE_DIR)
foreach(library IN LISTS SuiteSparse_LIBRARIES)
  string(TOLOWER ${library} name)
  if(SuiteSparse_LATE_BLAS)
    find_library(SuiteSparse_${library}_ARCHIVE ${CMAKE_STATIC_LIBRARY_PREFIX}${name}${CMAKE_STATIC_LIBRARY_SUFFIX})
    set(SuiteSparse_${library} ${SuiteSparse_${library}_ARCHIVE})
  else()
    find_library(SuiteSparse_${library}_LIBRARY ${name})
    set(SuiteSparse_${library} ${SuiteSparse_${library}_LIBRARY})
  endif()
  list(APPEND SuiteSparse_REQUIRED SuiteSparse_${library})
endforeach()
if(SuiteSparse_LATE_BLAS)
  set(SuiteSparse_LAPACK ${SuiteSparse_LATE_BLAS} ${CMAKE_DL_LIBS})
else()
  find_library(SuiteSparse_LAPACK_LIBRARY lapack)
  set(SuiteSparse_LAPACK ${SuiteSparse_LAPACK_LIBRARY})
  list(APPEND SuiteSparse_REQUIRED SuiteSparse_LAPACK_LIBRARY)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SuiteSparse REQUIRED_VARS ${SuiteSparse_REQUIRED})

if(SuiteSparse_FOUND AND NOT TARGET SuiteSparse::cholmod)
  add_library(SuiteSparse::cholmod UNKNOWN IMPORTED)
  set_target_properties(SuiteSparse::cholmod PROPERTIES IMPORTED_LOCATION "${SuiteSparse_CHOLMOD}"
    INTERFACE_INCLUDE_DIRECTORIES "${SuiteSparse_INCLUDE_DIR}")
  target_link_libraries(SuiteSparse::cholmod INTERFACE ${SuiteSparse_AMD} ${SuiteSparse_COLAMD} ${SuiteSparse_CCOLAMD}
    ${SuiteSparse_CAMD} ${SuiteSparse_SUITESPARSECONFIG} ${SuiteSparse_LAPACK})
  add_library(SuiteSparse::umfpack UNKNOWN IMPORTED)
  set_target_properties(SuiteSparse::umfpack PROPERTIES IMPORTED_LOCATION "${SuiteSparse_UMFPACK}"
    INTERFACE_INCLUDE_DIRECTORIES "${SuiteSparse_INCLUDE_DIR}")
  target_link_libraries(SuiteSparse::umfpack INTERFACE SuiteSparse::cholmod)
endif()
