# `cmake --install build/release` and a Debian package (`cpack -G DEB`): the program, its manual, and
# the JSON Schemas of its results.
include(GNUInstallDirs)
install(TARGETS recoil RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES ${PROJECT_SOURCE_DIR}/docs/recoil.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${PROJECT_SOURCE_DIR}/docs/recoil.bash RENAME recoil
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}
        FILES_MATCHING PATTERN *.md PATTERN *.svg PATTERN site EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/schemas DESTINATION ${CMAKE_INSTALL_DATADIR}/recoil)

# find_package(recoil) of other CMake projects: the package librecoil-dev.
include(CMakePackageConfigHelpers)
set(recoil_cmake_folder ${CMAKE_INSTALL_LIBDIR}/cmake/recoil)
set_target_properties(recoil_estimator PROPERTIES EXPORT_NAME estimator)
set_target_properties(recoil_library PROPERTIES EXPORT_NAME library)
install(TARGETS recoil_estimator recoil_library recoil_warnings EXPORT recoil
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT recoil NAMESPACE recoil:: FILE recoil-targets.cmake
        DESTINATION ${recoil_cmake_folder} COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/recoil
        COMPONENT development FILES_MATCHING PATTERN *.hpp
        PATTERN cli EXCLUDE PATTERN python EXCLUDE PATTERN web EXCLUDE)
# Others write #include "recoil/analysis/analysis.hpp", so that no header of theirs is mistaken for one
# of ours; inside, too.
install(CODE [[
  set(headers "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/include/recoil")
  file(GLOB_RECURSE files "${headers}/*.hpp")
  foreach(file IN LISTS files)
    file(STRINGS "${file}" own REGEX "#include \"[a-z]")
    if(NOT own MATCHES "\"recoil/")
      file(READ "${file}" text)
      string(REGEX REPLACE "#include \"([a-z]+/)" "#include \"recoil/\\1" text "${text}")
      file(WRITE "${file}" "${text}")
    endif()
  endforeach()]] COMPONENT development)
# Debian's libraries; those that have no .pc file are named.
configure_file(${PROJECT_SOURCE_DIR}/packaging.pc.in ${PROJECT_BINARY_DIR}/recoil.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/recoil.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
        COMPONENT development)
configure_file(${PROJECT_SOURCE_DIR}/packaging_config.cmake.in
               ${PROJECT_BINARY_DIR}/recoil-config.cmake COPYONLY)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/recoil-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/recoil-config.cmake
              ${PROJECT_BINARY_DIR}/recoil-config-version.cmake
        DESTINATION ${recoil_cmake_folder} COMPONENT development)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME recoil)
# Who makes the package maintains it, and says so as Debian's tools ask for it (dch(1): DEBFULLNAME,
# DEBEMAIL). The authors have no address to give; that of nobody is one that cannot exist (RFC 6761).
set(CPACK_PACKAGE_CONTACT "The recoil authors <nobody@recoil.invalid>")
if(NOT "$ENV{DEBFULLNAME}" STREQUAL "" AND NOT "$ENV{DEBEMAIL}" STREQUAL "")
  set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL Unspecified development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_NAME recoil)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME librecoil-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "${PROJECT_DESCRIPTION} (library and headers)")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libceres-dev, libeigen3-dev, libfmt-dev, libgsl-dev, \
libmd-dev, libpugixml-dev, libsndfile1-dev, libsundials-dev, libtbb-dev, libtomlplusplus-dev, \
libzip-dev, nlohmann-json3-dev")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_RECOMMENDS "librsvg2-bin, fonts-dejavu-core") # figures as PDF and PNG
set(CPACK_DEBIAN_PACKAGE_SECTION science)
include(CPack)
