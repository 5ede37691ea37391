#pragma once

#include <string>

#include "nade/hand_mesh.h"
#include "nade/status.h"

namespace nade {

/// Reads a skinned hand from a .glb or .gltf file whose skin has the 25 joints of WebXR by name,
/// in any order, in metres, with -Z to the fingertip and +Y to the back of the hand, as in
/// `generic-hand` of @webxr-input-profiles/assets. Only the mesh, JOINTS_0 and the inverse bind
/// matrices count, not the nodes' own transforms (as glTF has it for skins); a palm joint counts
/// as the middle metacarpal, any other as its nearest ancestor that is a joint of the hand.
/// Missing normals are computed. The error names the file and what was expected.
[[nodiscard]] Result<HandMesh> load_hand_mesh(const std::string& path, Handedness side);

}  // namespace nade
