# What is installed beside the program, and the Debian package: `cpack -G DEB` in the build folder.

# ---- Manual pages: the program's own help, novelview(1) and novelview-COMMAND(1) -----------------
find_program(HELP2MAN help2man)
if(HELP2MAN)
  # Which pages there are is known once the program is built: its help names its commands.
  set(manual "${CMAKE_BINARY_DIR}/man")
  add_custom_command(OUTPUT "${manual}/novelview.1"
    DEPENDS novelview "${CMAKE_CURRENT_LIST_DIR}/manual-pages.cmake"
    COMMAND "${CMAKE_COMMAND}" "-DPROGRAM=$<TARGET_FILE:novelview>" "-DHELP2MAN=${HELP2MAN}"
      "-DVERSION=${PROJECT_VERSION}" "-DFOLDER=${manual}"
      -P "${CMAKE_CURRENT_LIST_DIR}/manual-pages.cmake"
    VERBATIM)
  add_custom_target(novelview_man ALL DEPENDS "${manual}/novelview.1")
  install(DIRECTORY "${manual}/" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" FILES_MATCHING PATTERN "*.1")
endif()

install(FILES "${CMAKE_CURRENT_LIST_DIR}/novelview.bash"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" RENAME novelview)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/novelview" RENAME copyright)
# The pages refer to each other by their places in the source.
foreach(page README.md app/CHANGELOG.md app/README.md pipeline/README.md pipeline/python/README.md vtkfilters/README.md
    tests/README.md data/README.md)
  get_filename_component(folder "${page}" DIRECTORY)
  install(FILES "${PROJECT_SOURCE_DIR}/${page}"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/novelview/${folder}")
endforeach()

# ---- Package -------------------------------------------------------------------------------------
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The NovelView developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "novel views of an object from calibrated photographs")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Loaded at run time (pipeline/drawing/OpenGLLibrary.h), so that no linker knows of them.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libosmesa6 | libegl-mesa0")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "glmark2-data, python3-numpy, python3-vtk9")
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/package-python.cmake")
set(CPACK_NOVELVIEW_PYTHON "${NOVELVIEW_PYTHON_DESTINATION}")
include(CPack)
