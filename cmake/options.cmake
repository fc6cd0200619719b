# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT

# Which libraries are built, and with which libraries of others: with those that are found, unless told otherwise. What
# needs one that is not in the build says so by name.
set(all_components core scene io render run)
set(HOOKE_COMPONENTS ${all_components} CACHE STRING
  "Libraries to build: core, and any of scene, io, render, and of all of these run")
foreach(component IN LISTS HOOKE_COMPONENTS)
  if(NOT component IN_LIST all_components)
    message(FATAL_ERROR "HOOKE_COMPONENTS has \"${component}\"; known are ${all_components}")
  endif()
endforeach()
list(APPEND HOOKE_COMPONENTS core)
if("run" IN_LIST HOOKE_COMPONENTS)
  list(APPEND HOOKE_COMPONENTS scene io render)
endif()
list(REMOVE_DUPLICATES HOOKE_COMPONENTS)

# hooke_with(NAME USERS PACKAGES TEXT FOUND ...): the option HOOKE_WITH_NAME, ON where all variables FOUND are true. In a build
# without any of USERS, components, it is OFF.
function(hooke_with name users packages text)
  set(is_used OFF)
  foreach(user IN LISTS users)
    if(user IN_LIST HOOKE_COMPONENTS)
      set(is_used ON)
    endif()
  endforeach()
  if(NOT is_used)
    set(HOOKE_WITH_${name} OFF PARENT_SCOPE)
    return()
  endif()
  set(is_found ON)
  foreach(found IN LISTS ARGN)
    if(NOT ${found})
      set(is_found OFF)
    endif()
  endforeach()
  option(HOOKE_WITH_${name} "${text}" ${is_found})
  if(NOT HOOKE_WITH_${name})
    message(STATUS "Left out: ${text} (HOOKE_WITH_${name}; Debian: ${packages})")
  endif()
endfunction()

find_package(TBB QUIET)
hooke_with(TBB core "libtbb-dev" "Threads by oneTBB in place of Hooke's own" TBB_FOUND)
if("io" IN_LIST HOOKE_COMPONENTS)
  find_package(HDF5 QUIET COMPONENTS C)
  find_package(ZLIB QUIET)
endif()
hooke_with(HDF5 io "libhdf5-dev zlib1g-dev" "Run folders and checkpoints, by HDF5" HDF5_FOUND ZLIB_FOUND)
find_path(HOOKE_OPENVDB_HEADERS openvdb/openvdb.h)
mark_as_advanced(HOOKE_OPENVDB_HEADERS)
hooke_with(OPENVDB "scene;io" "libopenvdb-dev libboost-iostreams-dev" "Meshes as shapes, surfaces and volumes, by OpenVDB"
  HOOKE_OPENVDB_HEADERS)
if("render" IN_LIST HOOKE_COMPONENTS)
  find_package(PNG QUIET)
  find_package(PkgConfig QUIET)
  if(PKG_CONFIG_FOUND)
    pkg_check_modules(HOOKE_GL QUIET epoxy cairo)
  endif()
  find_package(OpenEXR QUIET CONFIG)
endif()
hooke_with(GL render "libepoxy-dev libpng-dev libcairo2-dev pkg-config" "Pictures, films and the window, by OpenGL"
  PNG_FOUND HOOKE_GL_FOUND)
hooke_with(OPENEXR render "libopenexr-dev" "Pictures in linear light, by OpenEXR" OpenEXR_FOUND)

# The program has everything.
set(hooke_program_can_be_built ${PROJECT_IS_TOP_LEVEL})
foreach(component IN LISTS all_components)
  if(NOT component IN_LIST HOOKE_COMPONENTS)
    set(hooke_program_can_be_built OFF)
  endif()
endforeach()
