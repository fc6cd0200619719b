# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
include(CMakePackageConfigHelpers)

get_property(libraries GLOBAL PROPERTY HOOKE_LIBRARIES)
install(TARGETS ${libraries} EXPORT hookeTargets)
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hooke FILES_MATCHING PATTERN "*.h")
install(DIRECTORY scenes schema DESTINATION ${CMAKE_INSTALL_DATADIR}/hooke)
install(EXPORT hookeTargets NAMESPACE hooke:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hooke)
configure_package_config_file(cmake/hookeConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/hookeConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hooke)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/hookeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hookeConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/hookeConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hooke)
if(HOOKE_BUILD_APPS)
  install(TARGETS hooke)
  if(TARGET hooke-view)
    install(TARGETS hooke-view)
  endif()
endif()
if(TARGET hooke-gl)
  install(TARGETS hooke-gl LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/hooke)
endif()
