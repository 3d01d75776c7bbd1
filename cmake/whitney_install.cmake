# Installs the libraries, their headers and a package, so that another project needs only
#   find_package(whitney-toolkit) and target_link_libraries(... whitney::whitney)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/whitney-toolkit)

# One component, so that a test can install it before the program is built.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
install(TARGETS whitney_coxeter whitney_perturbation whitney_whitney EXPORT whitney-toolkit-targets
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/whitney-toolkit)
install(EXPORT whitney-toolkit-targets NAMESPACE whitney:: DESTINATION ${package_dir})

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/whitney-toolkit-config.cmake.in
  ${PROJECT_BINARY_DIR}/whitney-toolkit-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/whitney-toolkit-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/whitney-toolkit-config.cmake
  ${PROJECT_BINARY_DIR}/whitney-toolkit-config-version.cmake DESTINATION ${package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
