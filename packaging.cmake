# `cmake --install build/release` and a Debian package (`cpack -G DEB`): the program, which carries
# its manual along, its pages for man(1) and what shells complete. These are made by the program.
include(GNUInstallDirs)
install(TARGETS recoil RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(CODE "
  set(share \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/share\")
  set(program \"$<TARGET_FILE:recoil>\")
  file(MAKE_DIRECTORY \"\${share}/bash-completion/completions\" \"\${share}/zsh/site-functions\"
       \"\${share}/fish/vendor_completions.d\")
  execute_process(COMMAND \"\${program}\" help --man \"\${share}/man/man1\"
                  COMMAND_ERROR_IS_FATAL ANY)
  foreach(to bash:bash-completion/completions/recoil zsh:zsh/site-functions/_recoil
          fish:fish/vendor_completions.d/recoil.fish)
    string(REPLACE \":\" \";\" to \"\${to}\")
    list(GET to 0 shell)
    list(GET to 1 file)
    execute_process(COMMAND \"\${program}\" help --completion \${shell}
                    OUTPUT_FILE \"\${share}/\${file}\" COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME recoil)
set(CPACK_PACKAGE_CONTACT "The recoil authors <recoil@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
include(CPack)
