#pragma once

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <span>
#include <vector>

#include "gl_objects.h"
#include "nade/draw/renderer.h"

namespace nade::draw {

/// Places of the vertex attributes in every shader.
enum Attribute : GLuint {
  kPositionAttribute,
  kNormalAttribute,
  kColorAttribute,
  kTexcoordAttribute,
  kRestAttribute,  ///< the position when the mesh was added: what grain and hair stick to
};

/// A mesh on the graphics card.
struct StoredMesh {
  GlVertexArray layout;
  GlBuffer positions;
  GlBuffer normals;
  GlBuffer rest;
  GlBuffer colors;
  GlBuffer texcoords;
  GlBuffer indices;
  GlTexture texture;
  GLsizei index_count = 0;
  std::size_t vertex_count = 0;
  Material material;
  Eigen::AlignedBox3f box;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< to compute normals from
  std::vector<Eigen::Vector3f> computed_normals;        ///< room for them
  bool has_colors = false;
};

/// The meshes of a renderer.
class MeshStore {
 public:
  [[nodiscard]] MeshId add(const DrawnMesh& mesh);
  void remove(MeshId mesh);
  void set_shape(MeshId mesh, std::span<const Eigen::Vector3f> positions,
                 std::span<const Eigen::Vector3f> normals);
  void set_colors(MeshId mesh, std::span<const Color> colors);
  void set_material(MeshId mesh, const Material& material);
  void set_texture(MeshId mesh, const Image& image);

  /// One that was added and not removed.
  [[nodiscard]] const StoredMesh& at(MeshId mesh) const;

 private:
  [[nodiscard]] StoredMesh& at(MeshId mesh);

  std::map<MeshId, StoredMesh> meshes_;
  std::uint32_t next_ = 1;
};

}  // namespace nade::draw
