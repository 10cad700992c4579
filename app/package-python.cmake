# Debian's Python looks below /usr only in python3, without a minor version; the package is elsewhere
# when it was configured for another prefix.
set(staged "${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr")
if(IS_DIRECTORY "${staged}/${CPACK_NOVELVIEW_PYTHON}/novelview"
    AND NOT CPACK_NOVELVIEW_PYTHON STREQUAL "lib/python3/dist-packages")
  file(MAKE_DIRECTORY "${staged}/lib/python3/dist-packages")
  file(RENAME "${staged}/${CPACK_NOVELVIEW_PYTHON}/novelview"
    "${staged}/lib/python3/dist-packages/novelview")
endif()
