# Install and export: find_package(bitshade) gives bitshade::bitshade, bitshade::interop and, where it
# was built, bitshade::bulk.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(bitshade_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/bitshade)

set(bitshade_exported bitshade bitshade_interop)
if(TARGET bitshade_bulk)
  list(APPEND bitshade_exported bitshade_bulk)
endif()
install(TARGETS ${bitshade_exported} EXPORT bitshade_targets
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(TARGET bitshade_command)
  install(TARGETS bitshade_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(EXPORT bitshade_targets NAMESPACE bitshade:: DESTINATION ${bitshade_package_dir})

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/bitshadeConfig.cmake.in
  ${PROJECT_BINARY_DIR}/bitshadeConfig.cmake INSTALL_DESTINATION ${bitshade_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/bitshadeConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/bitshadeConfig.cmake
  ${PROJECT_BINARY_DIR}/bitshadeConfigVersion.cmake DESTINATION ${bitshade_package_dir})
