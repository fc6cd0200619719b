# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT

# hooke_library(NAME [INTERFACE] COMPONENT NAME [SOURCES ...] [PUBLIC_HEADERS ...] [LINKS ...] [PRIVATE_LINKS ...]
#               [PRECOMPILED HEADER ...])
# One static (or header-only) library of src/, exported as hooke::NAME. COMPONENT: the part of the installed package that it
# belongs to (cmake/install.cmake). PUBLIC_HEADERS: those that are installed, and described in the documentation. LINKS may only name libraries below it:
# tests/layering checks includes and links. PRECOMPILED: headers that most of its sources include and that take long;
# each source includes what it uses all the same.
set_property(GLOBAL PROPERTY HOOKE_EXPORTS)
set_property(GLOBAL PROPERTY HOOKE_PUBLIC_HEADERS)
function(hooke_library name)
  cmake_parse_arguments(ARG "INTERFACE" "COMPONENT" "SOURCES;PUBLIC_HEADERS;LINKS;PRIVATE_LINKS;PRECOMPILED" ${ARGN})
  set(target hooke_${name})
  if(ARG_INTERFACE)
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  else()
    add_library(${target} STATIC ${ARG_SOURCES})
    set(scope PUBLIC)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:hooke_compiler_flags> ${ARG_PRIVATE_LINKS})
    if(ARG_PRECOMPILED)
      target_precompile_headers(${target} PRIVATE ${ARG_PRECOMPILED})
    endif()
  endif()
  add_library(hooke::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                                $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(${target} ${scope} cxx_std_20)
  target_link_libraries(${target} ${scope} ${ARG_LINKS})
  if(NOT ARG_COMPONENT)
    message(FATAL_ERROR "${name} needs a COMPONENT")
  endif()
  if(NOT HOOKE_INSTALL)
    return()
  endif()
  install(TARGETS ${target} EXPORT hooke-${ARG_COMPONENT} ARCHIVE COMPONENT development)
  foreach(header IN LISTS ARG_PUBLIC_HEADERS)
    file(RELATIVE_PATH place ${PROJECT_SOURCE_DIR}/src ${CMAKE_CURRENT_SOURCE_DIR}/${header})
    cmake_path(GET place PARENT_PATH folder)
    install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hooke/${folder} COMPONENT development)
    set_property(GLOBAL APPEND PROPERTY HOOKE_PUBLIC_HEADERS ${place})
  endforeach()
  set_property(GLOBAL APPEND PROPERTY HOOKE_EXPORTS ${ARG_COMPONENT})
endfunction()

# A module that programs load when they need it (run/module_loader.h): it lies where they look.
function(hooke_module name source library)
  add_library(${name} MODULE ${source})
  set_target_properties(${name} PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_link_libraries(${name} PRIVATE hooke_compiler_flags ${library})
  target_compile_definitions(${name} PRIVATE HOOKE_VERSION="${PROJECT_VERSION}")
  target_link_options(${name} PRIVATE LINKER:--exclude-libs,ALL)
endfunction()
