# `cmake --install`, and a package that another project finds with find_package(keyline).
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/keyline)
install(TARGETS keyline EXPORT keyline-targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS keyline_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS keyline_image_io LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/keyline)
install(TARGETS keyline-exr-helper RUNTIME DESTINATION ${CMAKE_INSTALL_LIBDIR}/keyline)
install(DIRECTORY engine DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/keyline
        FILES_MATCHING PATTERN "*.h" PATTERN "*-inl.h" EXCLUDE PATTERN "image_io*.h" EXCLUDE)
install(DIRECTORY graphs DESTINATION ${CMAKE_INSTALL_DATADIR}/keyline)

install(EXPORT keyline-targets NAMESPACE keyline:: DESTINATION ${package_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/keyline-config.cmake.in
  ${PROJECT_BINARY_DIR}/keyline-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/keyline-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/keyline-config.cmake ${PROJECT_BINARY_DIR}/keyline-config-version.cmake
        DESTINATION ${package_dir})
