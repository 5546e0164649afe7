# `cmake --install`, and a package that another project finds with find_package(keyline).
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/keyline)
install(TARGETS keyline EXPORT keyline-targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS keyline_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS keyline-exr-helper keyline-picture-helper RUNTIME DESTINATION ${CMAKE_INSTALL_LIBDIR}/keyline)
# The public face, what a program or a node is written against: the headers that say so (engine/base/api.h).
file(GLOB_RECURSE headers RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/engine/*.h)
foreach(header IN LISTS headers)
  file(STRINGS ${PROJECT_SOURCE_DIR}/${header} public REGEX "KEYLINE_API")
  if(public)
    cmake_path(GET header PARENT_PATH folder)
    install(FILES ${PROJECT_SOURCE_DIR}/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/keyline/${folder})
  endif()
endforeach()
install(DIRECTORY editors graphs DESTINATION ${CMAKE_INSTALL_DATADIR}/keyline)

install(EXPORT keyline-targets NAMESPACE keyline:: DESTINATION ${package_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/keyline-config.cmake.in
  ${PROJECT_BINARY_DIR}/keyline-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/keyline-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/keyline-config.cmake ${PROJECT_BINARY_DIR}/keyline-config-version.cmake
        DESTINATION ${package_dir})
