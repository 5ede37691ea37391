# Runs packaging/vcpkg's portfile as vcpkg would, up to compiling, with what it calls replaced:
#   cmake -DSOURCE=. -DFOLDER=build/vcpkg -P tests/vcpkg/run_port.cmake
cmake_minimum_required(VERSION 3.25)
set(CURRENT_PORT_DIR "${SOURCE}/packaging/vcpkg/nade")
set(CURRENT_PACKAGES_DIR "${FOLDER}/packages")
file(REMOVE_RECURSE "${FOLDER}")

file(READ "${CURRENT_PORT_DIR}/vcpkg.json" manifest)
string(JSON PORT GET "${manifest}" name)
string(JSON version GET "${manifest}" version)
file(STRINGS "${SOURCE}/include/nade/version.h" ours REGEX "^#define NADE_VERSION \"${version}\"")
if(NOT ours)
  message(FATAL_ERROR "vcpkg.json: expected the version of include/nade/version.h, found ${version}")
endif()

function(expect_path path)
  if(NOT EXISTS "${path}")
    message(FATAL_ERROR "the port names ${path}, which is not there")
  endif()
endfunction()

# An option that the project does not know is an error with vcpkg, too.
function(vcpkg_cmake_configure)
  cmake_parse_arguments(ARG "" "SOURCE_PATH" "OPTIONS" ${ARGN})
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -S "${ARG_SOURCE_PATH}" -B "${FOLDER}/build" -G Ninja
      -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_LIBDIR=lib ${ARG_OPTIONS}
    OUTPUT_QUIET ERROR_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
  if(said MATCHES "not used by the project")
    message(FATAL_ERROR "${said}")
  endif()
endfunction()
# What would be installed, with empty files for what would be built.
function(vcpkg_cmake_install)
  file(GLOB_RECURSE scripts "${FOLDER}/build/cmake_install.cmake")
  foreach(script ${scripts})
    file(READ "${script}" text)
    string(REGEX MATCHALL "\"${FOLDER}/build/[^\"]*\\.(so[.0-9]*|a)\"" libraries "${text}")
    foreach(library ${libraries})
      string(REPLACE "\"" "" library "${library}")
      file(TOUCH "${library}")
    endforeach()
  endforeach()
  execute_process(COMMAND "${CMAKE_COMMAND}" --install "${FOLDER}/build" --prefix "${CURRENT_PACKAGES_DIR}"
    OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  expect_path("${CURRENT_PACKAGES_DIR}/include/nade/corrector.h")
  expect_path("${CURRENT_PACKAGES_DIR}/include/nade.h")
endfunction()
function(vcpkg_cmake_config_fixup)
  cmake_parse_arguments(ARG "" "CONFIG_PATH" "" ${ARGN})
  expect_path("${CURRENT_PACKAGES_DIR}/${ARG_CONFIG_PATH}/${PORT}Config.cmake")
endfunction()
function(vcpkg_fixup_pkgconfig)
  expect_path("${CURRENT_PACKAGES_DIR}/lib/pkgconfig/nade.pc")
endfunction()
function(vcpkg_install_copyright)
  cmake_parse_arguments(ARG "" "" "FILE_LIST" ${ARGN})
  expect_path("${ARG_FILE_LIST}")
endfunction()

include("${CURRENT_PORT_DIR}/portfile.cmake")
expect_path("${CURRENT_PACKAGES_DIR}/share/${PORT}/usage")
