# `cpack -G DEB` makes a package of Debian's, `cpack -G TGZ` a tarball that runs wherever it is unpacked: it brings along
# the libraries of the program and of its helper for OpenEXR.  OpenImageIO's, some 250 and a third of a gigabyte, it does
# not: `check` in it says whether they are there.
set(CPACK_PACKAGE_NAME keyline)
set(CPACK_PACKAGE_CONTACT "The Keyline Authors <keyline@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGE_FILE_NAME keyline-${PROJECT_VERSION}-linux-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/package-of-generator.cmake)
set(CPACK_COMPONENTS_ALL runtime)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME keyline)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS graphviz)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)

# Whatever any Linux of the C library's own has; of another version there is none that would fit the kernel's loader.
install(RUNTIME_DEPENDENCY_SET brought_along
        PRE_EXCLUDE_REGEXES [[^(ld-linux.*|lib(c|m|mvec|dl|rt|pthread|resolv|util)\.so)]] [[^libkeyline\.so]]
        LIBRARY DESTINATION ${program_dir}/libraries COMPONENT libraries EXCLUDE_FROM_ALL)
install(PROGRAMS ${CMAKE_CURRENT_LIST_DIR}/check DESTINATION . COMPONENT libraries EXCLUDE_FROM_ALL)
include(CPack)
