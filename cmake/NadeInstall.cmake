# Installing, and the package that find_package(nade) finds.
include(CMakePackageConfigHelpers)

set(nade_libraries nade)
if(NADE_BUILD_C)
  list(APPEND nade_libraries nade_c nade_c_static)
  install(FILES include/nade.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endif()
if(NADE_BUILD_IO)
  list(APPEND nade_libraries nade_io)
endif()
if(NADE_BUILD_EVAL)
  list(APPEND nade_libraries nade_eval)
endif()
if(TARGET nade_study)
  list(APPEND nade_libraries nade_study)
endif()
if(NADE_BUILD_DRAW)
  list(APPEND nade_libraries nade_draw)
endif()
install(TARGETS ${nade_libraries} EXPORT nadeTargets)
install(EXPORT nadeTargets NAMESPACE nade:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/nade)

install(DIRECTORY include/nade DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.h"
  PATTERN "io" EXCLUDE
  PATTERN "eval" EXCLUDE
  PATTERN "study" EXCLUDE
  PATTERN "draw" EXCLUDE)
if(NADE_BUILD_IO)
  install(DIRECTORY include/nade/io DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nade)
endif()
if(NADE_BUILD_EVAL)
  install(DIRECTORY include/nade/eval DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nade)
endif()
if(TARGET nade_study)
  install(DIRECTORY include/nade/study DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nade)
endif()
if(NADE_BUILD_DRAW)
  install(DIRECTORY include/nade/draw DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nade)
endif()

configure_package_config_file(cmake/nadeConfig.cmake.in nadeConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/nade)
write_basic_package_version_file(nadeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/nadeConfig.cmake" "${PROJECT_BINARY_DIR}/nadeConfigVersion.cmake"
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/nade)

# Written while installing, because the prefix may be chosen only then.
set(nade_pkg_configs nade-cpp)
if(NADE_BUILD_C)
  list(APPEND nade_pkg_configs nade)
endif()
foreach(name ${nade_pkg_configs})
  install(CODE "set(CMAKE_INSTALL_LIBDIR \"${CMAKE_INSTALL_LIBDIR}\")
set(CMAKE_INSTALL_INCLUDEDIR \"${CMAKE_INSTALL_INCLUDEDIR}\")
set(PROJECT_VERSION \"${PROJECT_VERSION}\")
set(PROJECT_DESCRIPTION \"${PROJECT_DESCRIPTION}\")
configure_file(\"${PROJECT_SOURCE_DIR}/cmake/${name}.pc.in\" \"${PROJECT_BINARY_DIR}/${name}.pc\" @ONLY)")
  install(FILES "${PROJECT_BINARY_DIR}/${name}.pc" DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

if(NADE_BUILD_APPS)
  install(TARGETS nade_cli)
  install(DIRECTORY "${NADE_SHARE_DIR}/" DESTINATION ${CMAKE_INSTALL_DATADIR}/nade)
endif()
install(FILES LICENSE THIRD_PARTY.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
