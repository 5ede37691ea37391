# Puts the hand models that scripts/fetch_assets keeps where programs look for what comes with
# nade: share/nade, beside bin.
if(NOT NADE_ASSET_CACHE)
  execute_process(COMMAND "${PROJECT_SOURCE_DIR}/scripts/fetch_assets" --where
    OUTPUT_VARIABLE nade_asset_cache OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set(NADE_ASSET_CACHE "${nade_asset_cache}" CACHE PATH "Where scripts/fetch_assets keeps its files")
endif()

set(NADE_SHARE_DIR "${PROJECT_BINARY_DIR}/share/nade")
set(nade_hands "${NADE_ASSET_CACHE}/webxr-input-profiles-assets-1.0.20")
foreach(file left.glb right.glb LICENSE.md)
  if(EXISTS "${nade_hands}/${file}")
    configure_file("${nade_hands}/${file}" "${NADE_SHARE_DIR}/hands/${file}" COPYONLY)
  else()
    message(WARNING "${nade_hands}/${file} is missing: run scripts/fetch_assets, then configure "
      "again; until then no program finds a hand to draw.")
    break()
  endif()
endforeach()
