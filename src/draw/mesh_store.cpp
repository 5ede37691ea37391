#include "mesh_store.h"

#include <algorithm>
#include <cmath>

#include "nade/assert.h"
#include "vertex_normals.h"

namespace nade::draw {
namespace {

using Vec3f = Eigen::Vector3f;

constexpr float kMostAnisotropy = 8.0F;

/// The mean of the faces about each vertex, by their angles there.
void compute_normals(std::span<const Vec3f> positions,
                     std::span<const std::array<std::uint32_t, 3>> triangles,
                     std::span<Vec3f> normals) {
  std::fill(normals.begin(), normals.end(), Vec3f::Zero());
  for (const auto& triangle : triangles) {
    const Vec3f& a = positions[triangle[0]];
    const Vec3f& b = positions[triangle[1]];
    const Vec3f& c = positions[triangle[2]];
    const Vec3f face = (b - a).cross(c - a);
    const float length = face.norm();
    if (!(length > 0.0F)) continue;
    const Vec3f normal = face / length;
    normals[triangle[0]] += angle_between(b - a, c - a) * normal;
    normals[triangle[1]] += angle_between(c - b, a - b) * normal;
    normals[triangle[2]] += angle_between(a - c, b - c) * normal;
  }
  for (Vec3f& normal : normals) {
    const float length = normal.norm();
    normal = length > 0.0F ? Vec3f(normal / length) : Vec3f(Vec3f::UnitY());
  }
}

template <class Element>
GLsizeiptr bytes_of(std::span<const Element> elements) {
  return static_cast<GLsizeiptr>(elements.size_bytes());
}

/// A buffer that feeds an attribute, with room for one element a vertex.
template <class Element>
GlBuffer feed(StoredMesh& mesh, Attribute attribute, std::span<const Element> elements,
              GLbitfield flags) {
  GlBuffer buffer = make_buffer(bytes_of(elements), elements.data(), flags);
  const GLuint layout = mesh.layout.get();
  glVertexArrayVertexBuffer(layout, attribute, buffer.get(), 0, sizeof(Element));
  glVertexArrayAttribFormat(layout, attribute, sizeof(Element) / sizeof(float), GL_FLOAT, GL_FALSE,
                            0);
  glVertexArrayAttribBinding(layout, attribute, attribute);
  glEnableVertexArrayAttrib(layout, attribute);
  return buffer;
}

void fill_color_texture(GLuint name, const Image& image) {
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTextureSubImage2D(name, 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE,
                      image.rgba.data());
  glGenerateTextureMipmap(name);
}

GlTexture make_color_texture(const Image& image) {
  NADE_ASSERT(image.width > 0 && image.height > 0);
  NADE_ASSERT(image.rgba.size() ==
              4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  GlTexture texture = make_texture(GL_TEXTURE_2D);
  const int longest = std::max(image.width, image.height);
  const int levels = 1 + static_cast<int>(std::floor(std::log2(longest)));
  const GLuint name = texture.get();
  glTextureStorage2D(name, levels, GL_SRGB8_ALPHA8, image.width, image.height);
  fill_color_texture(name, image);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  if (epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic") ||
      epoxy_has_gl_extension("GL_ARB_texture_filter_anisotropic")) {
    glTextureParameterf(name, GL_TEXTURE_MAX_ANISOTROPY_EXT, kMostAnisotropy);
  }
  return texture;
}

Eigen::AlignedBox3f box_of(std::span<const Vec3f> positions) {
  Eigen::AlignedBox3f box;
  for (const Vec3f& position : positions) box.extend(position);
  return box;
}

}  // namespace

MeshId MeshStore::add(const DrawnMesh& drawn) {
  const std::size_t count = drawn.positions.size();
  NADE_ASSERT(drawn.normals.empty() || drawn.normals.size() == count);
  NADE_ASSERT(drawn.colors.empty() || drawn.colors.size() == count);
  NADE_ASSERT(drawn.texcoords.empty() || drawn.texcoords.size() == count);
  const MeshId id{next_++};
  StoredMesh& mesh = meshes_[id];
  mesh.material = drawn.material;
  mesh.vertex_count = count;
  mesh.box = box_of(drawn.positions);
  mesh.triangles = drawn.triangles;
  mesh.computed_normals.resize(count);
  mesh.layout = make_vertex_array();
  if (count == 0 || drawn.triangles.empty()) return id;

  const std::span<const Vec3f> positions(drawn.positions);
  std::span<const Vec3f> normals(drawn.normals);
  if (normals.empty()) {
    compute_normals(positions, mesh.triangles, mesh.computed_normals);
    normals = mesh.computed_normals;
  }
  mesh.positions = feed(mesh, kPositionAttribute, positions, GL_DYNAMIC_STORAGE_BIT);
  mesh.normals = feed(mesh, kNormalAttribute, normals, GL_DYNAMIC_STORAGE_BIT);
  mesh.rest = feed(mesh, kRestAttribute, positions, 0);
  if (!drawn.texcoords.empty()) {
    mesh.texcoords =
        feed(mesh, kTexcoordAttribute, std::span<const Eigen::Vector2f>(drawn.texcoords), 0);
    if (drawn.texture) mesh.texture = make_color_texture(*drawn.texture);
  }
  const std::span<const std::array<std::uint32_t, 3>> triangles(drawn.triangles);
  mesh.indices = make_buffer(bytes_of(triangles), triangles.data(), 0);
  mesh.index_count = static_cast<GLsizei>(3 * triangles.size());
  glVertexArrayElementBuffer(mesh.layout.get(), mesh.indices.get());
  set_colors(id, drawn.colors);
  // NVIDIA's driver 580 may draw these contents after set_shape() has replaced them, if it follows
  // at once: let them arrive.
  glFinish();
  return id;
}

void MeshStore::remove(MeshId mesh) {
  NADE_ASSERT(meshes_.count(mesh) == 1);
  meshes_.erase(mesh);
}

void MeshStore::set_shape(MeshId id, std::span<const Vec3f> positions,
                          std::span<const Vec3f> normals) {
  StoredMesh& mesh = at(id);
  NADE_ASSERT(positions.size() == mesh.vertex_count);
  NADE_ASSERT(normals.empty() || normals.size() == mesh.vertex_count);
  if (mesh.index_count == 0) return;
  if (normals.empty()) {
    compute_normals(positions, mesh.triangles, mesh.computed_normals);
    normals = mesh.computed_normals;
  }
  mesh.box = box_of(positions);
  glNamedBufferSubData(mesh.positions.get(), 0, bytes_of(positions), positions.data());
  glNamedBufferSubData(mesh.normals.get(), 0, bytes_of(normals), normals.data());
}

void MeshStore::set_colors(MeshId id, std::span<const Color> colors) {
  StoredMesh& mesh = at(id);
  NADE_ASSERT(colors.empty() || colors.size() == mesh.vertex_count);
  mesh.has_colors = !colors.empty() && mesh.index_count > 0;
  if (!mesh.has_colors) {
    glDisableVertexArrayAttrib(mesh.layout.get(), kColorAttribute);
    return;
  }
  if (mesh.colors) {
    glNamedBufferSubData(mesh.colors.get(), 0, bytes_of(colors), colors.data());
    glEnableVertexArrayAttrib(mesh.layout.get(), kColorAttribute);
    return;
  }
  mesh.colors = feed(mesh, kColorAttribute, colors, GL_DYNAMIC_STORAGE_BIT);
}

void MeshStore::set_material(MeshId mesh, const Material& material) {
  at(mesh).material = material;
}

void MeshStore::set_texture(MeshId id, const Image& image) {
  const StoredMesh& mesh = at(id);
  NADE_ASSERT(static_cast<bool>(mesh.texture));
  GLint width = 0;
  GLint height = 0;
  glGetTextureLevelParameteriv(mesh.texture.get(), 0, GL_TEXTURE_WIDTH, &width);
  glGetTextureLevelParameteriv(mesh.texture.get(), 0, GL_TEXTURE_HEIGHT, &height);
  NADE_ASSERT(image.width == width && image.height == height);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  fill_color_texture(mesh.texture.get(), image);
}

const StoredMesh& MeshStore::at(MeshId mesh) const {
  const auto found = meshes_.find(mesh);
  NADE_ASSERT(found != meshes_.end());
  return found->second;
}

StoredMesh& MeshStore::at(MeshId mesh) {
  const auto found = meshes_.find(mesh);
  NADE_ASSERT(found != meshes_.end());
  return found->second;
}

}  // namespace nade::draw
