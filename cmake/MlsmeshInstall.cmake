# Installed: libraries, headers, programs, and a package file, so that find_package(mlsmesh) gives mlsmesh::mlsmesh.
include(CMakePackageConfigHelpers)

install(TARGETS mlsmesh_core mlsmesh mlsmesh_options EXPORT mlsmeshTargets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/mlsmesh DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/launch_configs DESTINATION ${CMAKE_INSTALL_DATADIR}/mlsmesh)
install(EXPORT mlsmeshTargets NAMESPACE mlsmesh:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/mlsmesh)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/mlsmeshConfig.cmake.in
  ${PROJECT_BINARY_DIR}/mlsmeshConfig.cmake INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/mlsmesh)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/mlsmeshConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mlsmeshConfig.cmake ${PROJECT_BINARY_DIR}/mlsmeshConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/mlsmesh)
