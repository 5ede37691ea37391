# Builds the clone that this folder is in:
#   vcpkg install nade --overlay-ports=packaging/vcpkg
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../../.." ABSOLUTE)

# nade::c is a shared library with each triplet, beside the static ones.
set(VCPKG_POLICY_DLLS_IN_STATIC_LIBRARY enabled)

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    -DNADE_BUILD_IO=OFF
    -DNADE_BUILD_EVAL=OFF
    -DNADE_BUILD_STUDY=OFF
    -DNADE_BUILD_DRAW=OFF
    -DNADE_BUILD_APPS=OFF
    -DNADE_BUILD_TESTS=OFF
    -DNADE_BUILD_BENCH=OFF
    -DNADE_BUILD_EXAMPLES=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/nade)
vcpkg_fixup_pkgconfig()

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
file(INSTALL "${CURRENT_PORT_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
