# What is installed, and packed by cpack: the program with its ready grids, and the library with its CMake package.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The program, with manual pages and completions from its own texts.
set(texts ${PROJECT_BINARY_DIR}/texts)
set(man_pages "")
foreach(verb sweep info verify merge query export simulate characteristic plot tune reproduce serve report)
  list(APPEND man_pages ${texts}/portrait-${verb}.1)
  add_custom_command(OUTPUT ${texts}/portrait-${verb}.1 DEPENDS portrait VERBATIM
    COMMAND portrait man ${verb} > ${texts}/portrait-${verb}.1)
endforeach()
file(MAKE_DIRECTORY ${texts})
add_custom_command(OUTPUT ${texts}/portrait.1 ${texts}/portrait.bash ${texts}/_portrait DEPENDS portrait VERBATIM
  COMMAND portrait man > ${texts}/portrait.1
  COMMAND portrait completion bash > ${texts}/portrait.bash
  COMMAND portrait completion zsh > ${texts}/_portrait)
add_custom_target(portrait_texts ALL DEPENDS ${texts}/portrait.1 ${man_pages})

install(TARGETS portrait RUNTIME COMPONENT program)
install(FILES ${texts}/portrait.1 ${man_pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${texts}/portrait.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME portrait COMPONENT program)
install(FILES ${texts}/_portrait DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
install(DIRECTORY grids/catalog DESTINATION ${CMAKE_INSTALL_DATADIR}/portrait COMPONENT program)
# Debian policy: a package says under which terms it may be copied.
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/portrait RENAME copyright COMPONENT program)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/portrait-dev RENAME copyright COMPONENT development)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/portrait COMPONENT program)
install(FILES grids/README.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/portrait/grids COMPONENT program)
install(FILES portraits/FORMAT.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/portrait/portraits COMPONENT program)

# The library: find_package(Portrait) gives Portrait::sweep, Portrait::query, ... , one a folder as in engine/README.md.
set(headers ${CMAKE_INSTALL_INCLUDEDIR}/portrait)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/Portrait)
foreach(library options base measures loop kernel reference sweep records rules grids portraits query)
  set_target_properties(portrait_${library} PROPERTIES EXPORT_NAME ${library})
  install(TARGETS portrait_${library} EXPORT PortraitTargets COMPONENT development
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} INCLUDES DESTINATION ${headers})
endforeach()
foreach(folder engine grids portraits)
  install(DIRECTORY ${folder} DESTINATION ${headers} COMPONENT development FILES_MATCHING PATTERN "*.h")
endforeach()
install(EXPORT PortraitTargets NAMESPACE Portrait:: DESTINATION ${package} COMPONENT development)
configure_package_config_file(cmake/PortraitConfig.cmake.in ${PROJECT_BINARY_DIR}/PortraitConfig.cmake
  INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/PortraitConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/PortraitConfig.cmake ${PROJECT_BINARY_DIR}/PortraitConfigVersion.cmake
  DESTINATION ${package} COMPONENT development)

# cpack -G DEB in a build folder: portrait_VERSION_ARCH.deb and portrait-dev_VERSION_ARCH.deb
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME portrait)
set(CPACK_PACKAGE_CONTACT "the maintainers of Portrait <portrait@localhost>")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME portrait)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS gnuplot-nox)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME portrait-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "g++, cmake, pkgconf, libeigen3-dev, libhdf5-dev, libfmt-dev, libxxhash-dev, zlib1g-dev, libtomlplusplus-dev, nlohmann-json3-dev")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Performance portraits of control loops with dead time
 Simulates a closed loop once for every normalised controller setting of a grid
 and answers tuning questions from the stored measures.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Performance portraits: the library
 Static libraries, headers and a CMake package.")
include(CPack)
