# What `cmake --install` leaves: bin/lagen, include/lagen, lib/cmake/lagen, lib/python3/dist-packages/lagen, share/lagen/models,
# share/lagen/program (what `lagen run` compiles around a header), the manual page, completion for bash and zsh, and README,
# docs and licences in share/doc/lagen.
include(CMakePackageConfigHelpers)

set(LAGEN_INSTALL_CMAKE "${CMAKE_INSTALL_LIBDIR}/cmake/lagen")
set(LAGEN_INSTALL_MODELS "${CMAKE_INSTALL_DATADIR}/lagen/models")

set(LAGEN_INSTALL_PYTHON lib/python3/dist-packages CACHE STRING "Where the Python package goes, below the prefix")

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

install(DIRECTORY runtime/include/lagen DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h"
  PATTERN "README.md")
if(TARGET lagen)
  install(DIRECTORY runtime/program/ DESTINATION ${CMAKE_INSTALL_DATADIR}/lagen/program FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h")
  install(DIRECTORY python/lagen DESTINATION ${LAGEN_INSTALL_PYTHON} FILES_MATCHING PATTERN "*.py" PATTERN __pycache__ EXCLUDE)
endif()
if(TARGET lagen AND NOT CMAKE_CROSSCOMPILING) # scripts/command-pages asks the program
  install(FILES ${PROJECT_BINARY_DIR}/pages/lagen.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${PROJECT_BINARY_DIR}/pages/lagen DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${PROJECT_BINARY_DIR}/pages/_lagen DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
endif()
install(DIRECTORY models/ DESTINATION ${LAGEN_INSTALL_MODELS} FILES_MATCHING PATTERN "*.toml" PATTERN "*.csv")
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES README.md CHANGELOG.md LICENSE.md LICENSES/GPL-2.0-or-later.txt LICENSES/MIT.txt DESTINATION ${CMAKE_INSTALL_DOCDIR})
