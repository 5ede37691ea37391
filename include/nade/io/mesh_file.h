#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "nade/mesh.h"
#include "nade/status.h"

namespace nade {

/// A named spot on an object: where to stroke it. In a glTF file a node without a mesh, named
/// "place-…": +Y out of the surface, -Z the way the stroke goes.
struct MeshPlace {
  std::string name;  ///< without "place-"
  Pose pose;
};

/// One of the meshes of a file, where its scene has it.
struct MeshPart {
  std::string name;  ///< may be empty
  std::size_t vertices = 0;
  std::size_t triangles = 0;
};

/// An animation of a glTF file.
struct MeshAnimation {
  std::string name;         ///< may be empty
  double duration_s = 0.0;  ///< as the file says it
};

/// What a mesh file holds: all its triangles in one frame, and its places.
struct MeshFile {
  TriangleSoup soup;
  std::vector<MeshPlace> places;
  std::vector<MeshPart> parts{};            ///< of a glTF file; of others none
  std::vector<MeshAnimation> animations{};  ///< of a glTF file
  std::vector<std::string> warnings{};      ///< of what was not read, a sentence each
};

/// A file name's ending in lower case, ".glb" for "Dog.GLB"; empty where there is none.
[[nodiscard]] std::string ending_of(const std::string& path);

/// Whether a file's name says that it holds a mesh of a kind that `load_mesh` reads.
[[nodiscard]] bool has_mesh_ending(const std::string& path);

/// Reads .glb .gltf .obj .stl .ply .off, recognised by the name's ending; scene transforms are
/// applied. Positions are taken as metres. The error names the file and what is wrong with it;
/// only an .obj file that was cut off between two lines cannot be told from a whole one.
[[nodiscard]] Result<MeshFile> load_mesh(const std::string& path);

}  // namespace nade
