# What `cmake --install` leaves: bin/lagen, include/lagen, lib/cmake/lagen, share/lagen/models, share/lagen/program (what
# `lagen run` compiles around a header), the licences.
include(CMakePackageConfigHelpers)

set(LAGEN_INSTALL_CMAKE "${CMAKE_INSTALL_LIBDIR}/cmake/lagen")
set(LAGEN_INSTALL_MODELS "${CMAKE_INSTALL_DATADIR}/lagen/models")

set(lagen_exported lagen_runtime)
if(TARGET lagen)
  list(APPEND lagen_exported lagen)
endif()
install(TARGETS ${lagen_exported} EXPORT lagenTargets RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(EXPORT lagenTargets NAMESPACE lagen:: DESTINATION ${LAGEN_INSTALL_CMAKE})

configure_package_config_file(cmake/lagenConfig.cmake.in ${PROJECT_BINARY_DIR}/lagenConfig.cmake
                              INSTALL_DESTINATION ${LAGEN_INSTALL_CMAKE} PATH_VARS LAGEN_INSTALL_MODELS)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lagenConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lagenConfig.cmake ${PROJECT_BINARY_DIR}/lagenConfigVersion.cmake
              cmake/LagenGenerate.cmake DESTINATION ${LAGEN_INSTALL_CMAKE})

install(DIRECTORY runtime/include/lagen DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
if(TARGET lagen)
  install(DIRECTORY runtime/program/ DESTINATION ${CMAKE_INSTALL_DATADIR}/lagen/program FILES_MATCHING PATTERN "*.hpp")
endif()
install(DIRECTORY models/ DESTINATION ${LAGEN_INSTALL_MODELS} FILES_MATCHING PATTERN "*.toml" PATTERN "*.csv")
install(FILES LICENSE.md LICENSES/GPL-2.0-or-later.txt LICENSES/MIT.txt DESTINATION ${CMAKE_INSTALL_DOCDIR})
