#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nade/draw/scene.h"
#include "nade/io/object_file.h"

namespace nade::draw {

/// An object as it is drawn, in its own frame: the one a placement moves.
struct DressedObject {
  std::vector<DrawnMesh> meshes;
  std::vector<std::string> warnings;  ///< what could not be shown, a sentence each
};

/// How fine the triangles of large flat parts are: fine enough to be dented, or as few as will do.
enum class Weave : std::uint8_t { coarse, fine };

/// Dresses the plane as a table top, the sphere as a smooth ball, the dog in its coat, and a mesh
/// file in its own materials.
[[nodiscard]] Result<DressedObject> dress(const LoadedObject& object, Weave weave = Weave::coarse);

/// The meshes of a file that `load_mesh` could read, each with its material, colours and texture,
/// in the frame that `load_mesh` gives: of a .glb or .gltf file, of an .obj or .ply file.
[[nodiscard]] Result<DressedObject> load_gltf_meshes(const std::string& path);
[[nodiscard]] Result<DressedObject> load_plain_meshes(const std::string& path);

/// Gives each corner a normal of its own: the mean, by angle, of the faces that meet there at no
/// more than 40 degrees, as MeshSurface smooths them.
void compute_creased_normals(DrawnMesh& mesh);

/// sRGB, 0 to 1, as linear light.
[[nodiscard]] Color from_srgb(const Color& srgb);
/// Linear light as sRGB, 0 to 1.
[[nodiscard]] Color to_srgb(const Color& linear);

}  // namespace nade::draw
