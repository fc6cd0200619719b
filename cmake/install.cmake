# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
include(CMakePackageConfigHelpers)

# Each component's libraries are exported by themselves, so that who asks for one needs only what that one needs.
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/hooke)
get_property(exports GLOBAL PROPERTY HOOKE_EXPORTS)
list(REMOVE_DUPLICATES exports)
foreach(export IN LISTS exports)
  install(EXPORT hooke-${export} NAMESPACE hooke:: DESTINATION ${package_folder} COMPONENT development)
endforeach()
install(DIRECTORY scenes schema DESTINATION ${CMAKE_INSTALL_DATADIR}/hooke COMPONENT program)
set(hooke_built ${HOOKE_COMPONENTS})
if(TARGET hooke_volumes_openvdb)
  list(APPEND hooke_built meshes)
endif()
if(HOOKE_WITH_TBB)
  set(hooke_core_needs " and oneTBB")
endif()
configure_package_config_file(cmake/hookeConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/hookeConfig.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/hookeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hookeConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/hookeConfigVersion.cmake
  DESTINATION ${package_folder} COMPONENT development)
if(HOOKE_BUILD_APPS)
  install(TARGETS hooke COMPONENT program)
  if(TARGET hooke-view)
    install(TARGETS hooke-view COMPONENT program)
  endif()
endif()
if(TARGET hooke-gl)
  install(TARGETS hooke-gl LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/hooke COMPONENT program)
endif()
