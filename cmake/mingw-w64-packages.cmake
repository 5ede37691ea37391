# What nade::io and the command line need of packages that Debian has for Linux alone: their headers,
# without those of Linux beside them, and the code of tinygltf compiled in.
set(nade_headers "${CMAKE_BINARY_DIR}/headers")

function(nade_headers_from_system)
  file(MAKE_DIRECTORY "${nade_headers}")
  foreach(name ${ARGN})
    if(NOT EXISTS "/usr/include/${name}")
      message(FATAL_ERROR "/usr/include/${name} is missing: run scripts/install_packages --windows")
    endif()
    get_filename_component(last "${name}" NAME)
    file(CREATE_LINK "/usr/include/${name}" "${nade_headers}/${last}" SYMBOLIC)
  endforeach()
endfunction()

# A target of a package's headers alone.
function(nade_header_package target)
  if(NOT TARGET ${target})
    add_library(${target} INTERFACE IMPORTED GLOBAL)
    target_include_directories(${target} SYSTEM INTERFACE "${nade_headers}")
  endif()
endfunction()

macro(nade_provide_package method package)
  if("${package}" STREQUAL fmt)
    nade_headers_from_system(fmt)
    nade_header_package(fmt::fmt)
    target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY=1)
    set(fmt_FOUND TRUE)
  elseif("${package}" STREQUAL nlohmann_json)
    nade_headers_from_system(nlohmann)
    nade_header_package(nlohmann_json::nlohmann_json)
    set(nlohmann_json_FOUND TRUE)
  elseif("${package}" STREQUAL CLI11)
    nade_headers_from_system(CLI)
    nade_header_package(CLI11::CLI11)
    set(CLI11_FOUND TRUE)
  elseif("${package}" STREQUAL TinyGLTF)
    nade_headers_from_system(nlohmann tiny_gltf.h stb/stb_image.h stb/stb_image_write.h)
    nade_header_package(TinyGLTF::TinyGLTF)
    set(nade_tinygltf "${CMAKE_BINARY_DIR}/tinygltf.cpp")
    file(CONFIGURE OUTPUT "${nade_tinygltf}" CONTENT "#define TINYGLTF_IMPLEMENTATION
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <tiny_gltf.h>
")
    set_source_files_properties("${nade_tinygltf}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    set_property(TARGET TinyGLTF::TinyGLTF PROPERTY INTERFACE_SOURCES "${nade_tinygltf}")
    set(TinyGLTF_FOUND TRUE)
  endif()
endmacro()
cmake_language(SET_DEPENDENCY_PROVIDER nade_provide_package SUPPORTED_METHODS FIND_PACKAGE)
