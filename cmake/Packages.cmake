# Debian packages by CPack: `cpack` in a build folder that was configured with CMAKE_INSTALL_PREFIX=/usr. Two packages, as
# whoever runs the program needs neither headers nor the development packages of other libraries, and a third one where the
# Python module was built.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME arcwall)
set(CPACK_PACKAGE_CONTACT "The arcwall authors <authors@arcwall.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_COMPONENTS_ALL program development)
if(TARGET arcwall_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME arcwall)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# What the program loads by name when it needs it, which dpkg-shlibdeps does not see.
if(ARCWALL_STATIC_LIBRARIES)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libblas3 | libblas.so.3, liblapack3 | liblapack.so.3, libmetis5")
endif()
# Else Debian takes the reference BLAS.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libopenblas0-serial | libopenblas0")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "bash-completion, libarcwall-dev, parallel, xdg-utils")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
  "The program trace-path reads a structure from one text file, follows its
equilibrium path through limit points, snap-backs and changes of contact,
and writes the path and the events on it.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libarcwall-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4), libsuitesparse-dev (>= 1:5.12), zlib1g-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "cmake (>= 3.25), g++ (>= 4:12)")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
  "Headers, static libraries and the CMake configuration of arcwall::core,
arcwall::continuation, arcwall::elements, arcwall::contact, arcwall::model and
arcwall::answers, which follow equilibrium paths in programs in C++20.")

# The module is for one version of the interpreter, whose number is part of its file's name.
if(TARGET arcwall_python)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-arcwall)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), \
python3 (<< ${Python_VERSION_MAJOR}.${next_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-pandas, python3-matplotlib, python3-scipy")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "The Python package arcwall: reads a structure from a text or a dict, follows
its equilibrium path, and gives arrays, data frames, events and pictures; it
follows equations of one's own as well.")
endif()

# What every Debian package has: who may do what with it, and its history.
function(compress from to)
  execute_process(COMMAND ${GZIP_PROGRAM} -9nc ${from} OUTPUT_FILE ${to} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

string(TIMESTAMP package_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(cmake/debian_changelog.in ${PROJECT_BINARY_DIR}/changelog.Debian @ONLY)
compress(${PROJECT_BINARY_DIR}/changelog.Debian ${PROJECT_BINARY_DIR}/changelog.Debian.gz)
compress(${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_BINARY_DIR}/changelog.gz)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(FILES ${PROJECT_BINARY_DIR}/changelog.Debian.gz ${PROJECT_BINARY_DIR}/changelog.gz DESTINATION ${folder}
    COMPONENT ${component})
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/debian_copyright DESTINATION ${folder} RENAME copyright
    COMPONENT ${component})
endforeach()

include(CPack)
