# The program with its man page, completion and models (component runtime), and the libraries for others:
# headers under include/whirl, targets whirl::base ... whirl::pictures, found by find_package(whirl COMPONENTS ...).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/whirl)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
install(TARGETS whirl RUNTIME COMPONENT runtime)
if(TARGET whirl-mpi)  # no part of the package, which would need MPI
  install(TARGETS whirl-mpi RUNTIME COMPONENT mpi)
endif()
if(TARGET whirl_render)
  install(TARGETS whirl_render RUNTIME COMPONENT runtime)
endif()
set(man ${CMAKE_CURRENT_BINARY_DIR}/whirl.1.gz)
set(completion ${CMAKE_CURRENT_BINARY_DIR}/completion/whirl)
add_custom_command(
  OUTPUT ${man} ${completion}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_CURRENT_BINARY_DIR}/completion
  COMMAND bash -c "'${PROJECT_SOURCE_DIR}/tools/man-page' '$<TARGET_FILE:whirl>' | gzip -9n >'${man}'"
  COMMAND bash -c "'$<TARGET_FILE:whirl>' completion >'${completion}'"
  DEPENDS whirl ${PROJECT_SOURCE_DIR}/tools/man-page
  VERBATIM)
add_custom_target(whirl_pages ALL DEPENDS ${man} ${completion})
install(FILES ${man} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT runtime)
install(FILES ${completion} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT runtime)
install(DIRECTORY models DESTINATION ${CMAKE_INSTALL_DATADIR}/whirl COMPONENT runtime)
include(cmake/notices.cmake)
install(FILES ${whirl_notices} DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT runtime)

install(TARGETS whirl_options whirl_base EXPORT whirl-base)
foreach(library fe contact dyn data model results pictures io)
  install(TARGETS whirl_${library} EXPORT whirl-${library})
endforeach()
foreach(library base fe contact dyn data model results pictures io)
  set_target_properties(whirl_${library} PROPERTIES EXPORT_NAME ${library})
  add_library(whirl::${library} ALIAS whirl_${library})
  install(EXPORT whirl-${library} NAMESPACE whirl:: DESTINATION ${package})
endforeach()
install(DIRECTORY libbase libfe libcontact libdyn libdata libio DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/whirl
        FILES_MATCHING PATTERN "*.hpp")
set_target_properties(whirl_options PROPERTIES EXPORT_NAME options)

configure_package_config_file(cmake/whirlConfig.cmake.in whirlConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(whirlConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/whirlConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/whirlConfigVersion.cmake
              cmake/FindKLU.cmake
        DESTINATION ${package})

# cpack -G DEB in the build folder: Debian packages of the component runtime, and of the Python package
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL runtime)
if(WHIRL_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "the whirl authors <whirl@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "rotordynamics with contact")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME whirl)
set(CPACK_DEBIAN_RUNTIME_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-whirl)
set(CPACK_DEBIAN_PYTHON_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS
    "python3-scipy, python3-xarray, python3-pandas, python3-matplotlib")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
include(CPack)
