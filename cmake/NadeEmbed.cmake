# Puts files into a source file, as bytes, while building.
#   nade_embed(VARIABLE OUTPUT out.cpp NAMESPACE ns HEADER h.h FILES a.glsl b.ttf …)
# Each file becomes a line of the table `embedded_files()` that the header declares.
function(nade_embed)
  cmake_parse_arguments(ARG "" "OUTPUT" "FILES" ${ARGN})
  string(REPLACE ";" "|" files "${ARG_FILES}")
  add_custom_command(
    OUTPUT "${ARG_OUTPUT}"
    COMMAND "${CMAKE_COMMAND}" "-DOUTPUT=${ARG_OUTPUT}" "-DFILES=${files}"
            -P "${PROJECT_SOURCE_DIR}/cmake/embed_files.cmake"
    DEPENDS ${ARG_FILES} "${PROJECT_SOURCE_DIR}/cmake/embed_files.cmake"
    COMMENT "Embedding shaders and font"
    VERBATIM)
endfunction()
