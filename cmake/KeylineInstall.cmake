# `cmake --install`, and a package that another project finds with find_package(keyline).  What runs is the component
# `runtime`, what one builds against `development`; `libraries` are those of the system that a tarball brings along.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/keyline)
set(program_dir ${CMAKE_INSTALL_LIBDIR}/keyline)
install(TARGETS keyline EXPORT keyline-targets RUNTIME_DEPENDENCY_SET brought_along
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime)
install(TARGETS keyline_program RUNTIME_DEPENDENCY_SET brought_along
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
install(TARGETS keyline-exr-helper RUNTIME_DEPENDENCY_SET brought_along
        RUNTIME DESTINATION ${program_dir} COMPONENT runtime)
install(TARGETS keyline-picture-helper RUNTIME DESTINATION ${program_dir} COMPONENT runtime)
# The public face, what a program or a node is written against: the headers that say so (engine/base/api.h).
file(GLOB_RECURSE headers RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/engine/*.h)
foreach(header IN LISTS headers)
  file(STRINGS ${PROJECT_SOURCE_DIR}/${header} public REGEX "KEYLINE_API")
  if(public)
    cmake_path(GET header PARENT_PATH folder)
    install(FILES ${PROJECT_SOURCE_DIR}/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/keyline/${folder}
            COMPONENT development)
  endif()
endforeach()
install(DIRECTORY editors graphs DESTINATION ${CMAKE_INSTALL_DATADIR}/keyline COMPONENT runtime
        PATTERN node_modules EXCLUDE)

install(EXPORT keyline-targets NAMESPACE keyline:: DESTINATION ${package_dir} COMPONENT development)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/keyline-config.cmake.in
  ${PROJECT_BINARY_DIR}/keyline-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/keyline-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/keyline-config.cmake ${PROJECT_BINARY_DIR}/keyline-config-version.cmake
        DESTINATION ${package_dir} COMPONENT development)
