# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT

# Debian packages, by `make package`: hooke (the program, the window, scenes), hooke-mpi, libhooke-dev and python3-hooke.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME hooke)
set(CPACK_PACKAGE_CONTACT "The Hooke authors <hooke@example.org>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # what programs and modules link
set(CPACK_DEBIAN_PACKAGE_SECTION science)

# What pictures and films use where it is there: an installation without them computes all the same.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME hooke)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "fonts-dejavu-core, libegl1, libgl1, libgl1-mesa-dri")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, python3-hooke")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "spring-mass particle engine
 Grains, fluids, cloth, jelly, sparks and stars as hundreds of thousands of spheres that push, rub and damp each
 other through springs: scene files, runs, pictures and films, and a window to watch and to touch them.")

# The component core needs the first, the others what their names say (hookeConfig.cmake).
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libhooke-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)  # static libraries
set(development_depends libc6-dev)
set(development_recommends libfmt-dev)
if(HOOKE_WITH_TBB)
  list(APPEND development_depends libtbb-dev)
endif()
if(HOOKE_WITH_HDF5)
  list(APPEND development_recommends libhdf5-dev zlib1g-dev)
endif()
if(HOOKE_WITH_GL)
  list(APPEND development_recommends libcairo2-dev libepoxy-dev libpng-dev pkg-config)
endif()
if(HOOKE_WITH_OPENEXR)
  list(APPEND development_recommends libopenexr-dev)
endif()
if(HOOKE_WITH_OPENVDB)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "libopenvdb-dev, libboost-iostreams-dev")
endif()
list(JOIN development_depends ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
list(JOIN development_recommends ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "spring-mass particle engine: static libraries and headers
 For C++20 programs that embed Hooke, by CMake's find_package(hooke).")

if(TARGET hooke_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-hooke)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  math(EXPR next_minor "${HOOKE_PYTHON_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${HOOKE_PYTHON_MINOR}~), python3 (<< 3.${next_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "hooke (= ${PROJECT_VERSION})")  # has what draws
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "spring-mass particle engine: Python module
 Simulations that are stepped, read and steered from Python, with numpy arrays; runs, pictures and films.")
endif()

# The module of a cluster's ranks is a package of its own: who has one machine needs no MPI.
if(TARGET hooke-mpi)
  list(APPEND CPACK_COMPONENTS_ALL cluster)
  set(CPACK_DEBIAN_CLUSTER_PACKAGE_NAME hooke-mpi)
  set(CPACK_DEBIAN_CLUSTER_PACKAGE_DEPENDS "hooke (= ${PROJECT_VERSION}), openmpi-bin")
  set(CPACK_COMPONENT_CLUSTER_DESCRIPTION "spring-mass particle engine: ranks of a cluster
 For scenes that several processes compute together, on one machine or on many, by Open MPI.")
  string(APPEND CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS ", hooke-mpi")
endif()

foreach(component program cluster development python)
  string(TOUPPER ${component} upper)
  if(DEFINED CPACK_DEBIAN_${upper}_PACKAGE_NAME)
    install(FILES LICENSE DESTINATION share/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME} RENAME copyright
      COMPONENT ${component})
  endif()
endforeach()
include(CPack)
