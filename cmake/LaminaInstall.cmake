# What `cmake --install` puts where, in two components: the program with all
# that its users read, and the library for other programs.
include(CMakePackageConfigHelpers)
find_program(LAMINA_GZIP gzip REQUIRED)

# lamina_compress(<file> <name>): <name> in the build folder, as Debian wants it.
function(lamina_compress file name)
  set(result ${PROJECT_BINARY_DIR}/${name})
  add_custom_command(OUTPUT ${result}
    COMMAND ${LAMINA_GZIP} -9nc ${file} > ${result}
    DEPENDS ${file} VERBATIM)
  add_custom_target(lamina_${name} ALL DEPENDS ${result})
endfunction()

install(TARGETS lamina
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
lamina_compress(${PROJECT_SOURCE_DIR}/CHANGELOG.md changelog.gz)
install(FILES README.md SECURITY.md ${PROJECT_BINARY_DIR}/changelog.gz
              cmake/debian/copyright
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
lamina_compress(${PROJECT_BINARY_DIR}/cli/lamina.1 lamina.1.gz)
install(FILES ${PROJECT_BINARY_DIR}/lamina.1.gz
        DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(DIRECTORY docs examples
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program
        PATTERN man EXCLUDE PATTERN cpp EXCLUDE PATTERN python EXCLUDE)
install(DIRECTORY examples/python
        DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/python3-lamina/examples
        COMPONENT python)

install(PROGRAMS scripts/cluster/submit
        DESTINATION ${CMAKE_INSTALL_DOCDIR}/scripts/cluster COMPONENT program)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/lamina)
install(TARGETS lamina_api EXPORT lamina
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
                 COMPONENT development)
install(EXPORT lamina NAMESPACE lamina:: FILE lamina-targets.cmake
        DESTINATION ${package_folder} COMPONENT development)
configure_package_config_file(cmake/lamina-config.cmake.in lamina-config.cmake
  INSTALL_DESTINATION ${package_folder})
# Before 1.0 the second number tells what may break.
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/lamina-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lamina-config.cmake
              ${PROJECT_BINARY_DIR}/lamina-config-version.cmake
        DESTINATION ${package_folder} COMPONENT development)
install(DIRECTORY examples/cpp
        DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/lamina-dev/examples
        COMPONENT development)
