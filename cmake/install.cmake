# The program, and the libraries for others: headers under include/whirl, targets whirl::base ... whirl::io,
# found by find_package(whirl COMPONENTS ...).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/whirl)
install(TARGETS whirl RUNTIME)
install(TARGETS whirl_options whirl_base EXPORT whirl-base)
foreach(library fe contact dyn io)
  install(TARGETS whirl_${library} EXPORT whirl-${library})
endforeach()
foreach(library base fe contact dyn io)
  set_target_properties(whirl_${library} PROPERTIES EXPORT_NAME ${library})
  add_library(whirl::${library} ALIAS whirl_${library})
  install(EXPORT whirl-${library} NAMESPACE whirl:: DESTINATION ${package})
  install(DIRECTORY lib${library} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/whirl FILES_MATCHING PATTERN "*.hpp")
endforeach()
set_target_properties(whirl_options PROPERTIES EXPORT_NAME options)

configure_package_config_file(cmake/whirlConfig.cmake.in whirlConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(whirlConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/whirlConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/whirlConfigVersion.cmake
        DESTINATION ${package})
