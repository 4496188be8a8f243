# The files that `cmake --install` installs and that ci/package puts into the Debian package. Plans and shaders are embedded in
# the program.
include(GNUInstallDirs)
# Only the owner may write to installed files, regardless of the umask and of the permissions in the checkout.
set(for_all OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
set(folder_for_all ${for_all} OWNER_EXECUTE GROUP_EXECUTE WORLD_EXECUTE)
set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS ${folder_for_all})
install(TARGETS triptych RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TARGET triptych-view)
  install(TARGETS triptych-view RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT view)
endif()
install(DIRECTORY baselines analysis DESTINATION ${TRIPTYCH_DATA_FOLDER} FILE_PERMISSIONS ${for_all}
        DIRECTORY_PERMISSIONS ${folder_for_all} PATTERN __pycache__ EXCLUDE)
file(GLOB scripts RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS analysis/*)
foreach(script IN LISTS scripts)
  if(NOT IS_DIRECTORY ${PROJECT_SOURCE_DIR}/${script} AND NOT script MATCHES "\\.")
    install(PROGRAMS ${script} DESTINATION ${TRIPTYCH_DATA_FOLDER}/analysis)
  endif()
endforeach()
# Installs all files to which README.md links.
install(FILES README.md CHANGELOG.md CONTRIBUTING.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} FILE_PERMISSIONS ${for_all} DIRECTORY_PERMISSIONS ${folder_for_all})
install(DIRECTORY ci/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}/ci FILE_PERMISSIONS ${for_all}
        DIRECTORY_PERMISSIONS ${folder_for_all})
install(FILES ${TRIPTYCH_DOCUMENTS}/triptych.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${TRIPTYCH_DOCUMENTS}/triptych.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME triptych)
if(TARGET triptych_counter)
  # measure/counting/emulator.cpp looks in this folder, which does not depend on the multiarch name.
  install(TARGETS triptych_counter RUNTIME DESTINATION lib/triptych)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "Triptych's developers <triptych@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Libraries that are loaded by name at run time: the API loaders, and the software drivers that serve as a comparison for other
# drivers.
set(depends libegl1 libvulkan1 "pocl-opencl-icd | opencl-icd" "mesa-vulkan-drivers | vulkan-icd"
    "libegl-mesa0 | libegl-vendor" libgl1-mesa-dri)
# The counting tool contains code from the Valgrind version with which it was built. The installed Valgrind must have the same
# version.
if(TARGET triptych_counter)
  execute_process(COMMAND valgrind --version OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "[0-9]+\\.[0-9]+" VALGRIND_VERSION "${printed}")
  list(APPEND depends "valgrind (>= 1:${VALGRIND_VERSION})" "valgrind (<< 1:${VALGRIND_VERSION}.99)")
endif()
# Mesa 25.1 removed OSMesa.
find_library(OSMESA_LIBRARY NAMES libOSMesa.so.8)
if(OSMESA_LIBRARY)
  list(APPEND depends libosmesa6)
endif()
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-matplotlib, python3-pandas, python3-scipy, python3-sklearn")  # for analysis/
list(JOIN depends ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
# The window is in a separate package, because the main package must not depend on its libraries.
if(TARGET triptych-view)
  set(CPACK_DEB_COMPONENT_INSTALL ON)
  set(CPACK_COMPONENTS_GROUPING IGNORE)
  set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_NAME triptych)
  set(CPACK_DEBIAN_VIEW_PACKAGE_NAME triptych-view)
  set(CPACK_DEBIAN_VIEW_DESCRIPTION "Window of triptych view: devices side by side")
  set(CPACK_DEBIAN_VIEW_PACKAGE_DEPENDS "libgl1")
  set(CPACK_DEBIAN_VIEW_PACKAGE_SUGGESTS "fonts-dejavu-core")
  set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
  set(CPACK_COMPONENT_VIEW_DEPENDS Unspecified)
endif()
include(CPack)
