# Puts the hand models that scripts/fetch_assets keeps, and scenes, where programs look for what comes
# with nade: share/nade, beside bin.
if(NOT NADE_ASSET_CACHE)
  execute_process(COMMAND "${PROJECT_SOURCE_DIR}/scripts/fetch_assets" --where
    OUTPUT_VARIABLE nade_asset_cache OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set(NADE_ASSET_CACHE "${nade_asset_cache}" CACHE PATH "Where scripts/fetch_assets keeps its files")
endif()

set(NADE_SHARE_DIR "${PROJECT_BINARY_DIR}/share/nade")
set(nade_hands webxr-input-profiles-assets-1.0.20)
foreach(asset
    "${nade_hands}/left.glb>left.glb"
    "${nade_hands}/right.glb>right.glb"
    "${nade_hands}/LICENSE.md>LICENSE-generic-hand.md"
    "iwer-2.5.0/LICENSE>LICENSE-relaxed")
  string(REPLACE ">" ";" asset "${asset}")
  list(GET asset 0 from)
  list(GET asset 1 to)
  if(EXISTS "${NADE_ASSET_CACHE}/${from}")
    configure_file("${NADE_ASSET_CACHE}/${from}" "${NADE_SHARE_DIR}/hands/${to}" COPYONLY)
  else()
    message(WARNING "${NADE_ASSET_CACHE}/${from} is missing: run scripts/fetch_assets, then "
      "configure again; until then programs find no hand to draw.")
    break()
  endif()
endforeach()

# What `nade bench` plays beside strokes.
file(GLOB nade_scenes CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/scenes/*.json")
foreach(scene ${nade_scenes})
  get_filename_component(name "${scene}" NAME)
  configure_file("${scene}" "${NADE_SHARE_DIR}/scenes/${name}" COPYONLY)
endforeach()

# What comes with nade and is made while building; those who make it add themselves.
add_custom_target(nade_share ALL)
