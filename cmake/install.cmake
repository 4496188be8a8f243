# What a user gets by `cmake --install`, and ci/package as a Debian package. Plans and shaders are in the program.
include(GNUInstallDirs)
install(TARGETS triptych RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY baselines DESTINATION ${TRIPTYCH_DATA_FOLDER})
install(DIRECTORY analysis DESTINATION ${TRIPTYCH_DATA_FOLDER} USE_SOURCE_PERMISSIONS PATTERN __pycache__ EXCLUDE)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES ${TRIPTYCH_DOCUMENTS}/triptych.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${TRIPTYCH_DOCUMENTS}/triptych.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME triptych)
if(TARGET triptych_counter)
  # Where measure/counting/emulator.cpp looks, whatever the multiarch folder is.
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
# What is loaded by name: loaders, then drivers of the processor, with which others are compared.
set(depends libegl1 libvulkan1 "pocl-opencl-icd | opencl-icd" "mesa-vulkan-drivers | vulkan-icd"
    "libegl-mesa0 | libegl-vendor" libgl1-mesa-dri)
# The counting tool holds this Valgrind's own code, and asks the installed one for its version.
if(TARGET triptych_counter)
  execute_process(COMMAND valgrind --version OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "[0-9]+\\.[0-9]+" VALGRIND_VERSION "${printed}")
  list(APPEND depends "valgrind (>= 1:${VALGRIND_VERSION})" "valgrind (<< 1:${VALGRIND_VERSION}.99)")
endif()
# Gone from Mesa 25.1 on.
find_library(OSMESA_LIBRARY NAMES libOSMesa.so.8)
if(OSMESA_LIBRARY)
  list(APPEND depends libosmesa6)
endif()
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-matplotlib, python3-pandas, python3-scipy, python3-sklearn")  # of analysis
list(JOIN depends ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
include(CPack)
