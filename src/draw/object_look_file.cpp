#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <stb/stb_image.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>

#include "object_look.h"

namespace nade::draw {
namespace {

namespace fs = std::filesystem;

/// A file while it is taken over.
struct Source {
  const aiScene& scene;
  std::string path;
  bool gltf = false;  ///< colours are linear light
  std::map<std::string, std::shared_ptr<const Image>> textures{};
  std::uint32_t vertices = 0;  ///< so far, as `load_mesh` counts them
  DressedObject dressed{};
};

Image from_texels(const aiTexture& texture) {
  Image image = Image::blank(static_cast<int>(texture.mWidth), static_cast<int>(texture.mHeight));
  const std::size_t count = std::size_t{texture.mWidth} * texture.mHeight;
  for (std::size_t i = 0; i < count; ++i) {
    const aiTexel& texel = texture.pcData[i];
    const std::array<std::uint8_t, 4> rgba{texel.r, texel.g, texel.b, texel.a};
    std::copy(rgba.begin(), rgba.end(), image.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i));
  }
  return image;
}

/// A picture that lies in the file itself.
std::optional<Image> decode(const aiTexture& texture) {
  if (texture.mHeight != 0) return from_texels(texture);
  Image image;
  stbi_uc* const pixels = stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(texture.pcData),
                                                static_cast<int>(texture.mWidth), &image.width,
                                                &image.height, nullptr, 4);
  if (pixels == nullptr) return std::nullopt;
  image.rgba.assign(pixels, pixels + 4 * std::ptrdiff_t{image.width} * image.height);
  stbi_image_free(pixels);
  return image;
}

std::shared_ptr<const Image> load_texture(const std::string& name, Source& source) {
  const auto known = source.textures.find(name);
  if (known != source.textures.end()) return known->second;
  std::shared_ptr<const Image>& texture = source.textures[name];
  if (const aiTexture* const embedded = source.scene.GetEmbeddedTexture(name.c_str())) {
    if (std::optional<Image> image = decode(*embedded)) {
      texture = std::make_shared<const Image>(std::move(*image));
    } else {
      source.dressed.warnings.push_back(fmt::format(
          "{}: texture {}: expected a PNG or JPEG picture, so it is not shown", source.path, name));
    }
    return texture;
  }
  std::string file = name;
  std::replace(file.begin(), file.end(), '\\', '/');
  const Result<Image> image = load_image((fs::path(source.path).parent_path() / file).string());
  if (image) {
    texture = std::make_shared<const Image>(*image);
  } else {
    source.dressed.warnings.push_back(
        fmt::format("{}: its texture is not shown: {}", source.path, image.error().message));
  }
  return texture;
}

Color color_of(const aiColor4D& color, const Source& source) {
  const Color values(color.r, color.g, color.b);
  return source.gltf ? values : from_srgb(values);
}

void read_material(const aiMaterial& from, Source& source, DrawnMesh& mesh) {
  Material& material = mesh.material;
  aiColor4D color(0.7F, 0.7F, 0.7F, 1.0F);
  if (from.Get(AI_MATKEY_BASE_COLOR, color) != AI_SUCCESS) {
    from.Get(AI_MATKEY_COLOR_DIFFUSE, color);
  }
  material.base_color = color_of(color, source);
  float shininess = 0.0F;
  if (from.Get(AI_MATKEY_ROUGHNESS_FACTOR, material.roughness) != AI_SUCCESS &&
      from.Get(AI_MATKEY_SHININESS, shininess) == AI_SUCCESS && shininess > 0.0F) {
    // Walter et al. 2007: Blinn-Phong's exponent as the roughness squared.
    material.roughness = std::pow(2.0F / (shininess + 2.0F), 0.25F);
  }
  from.Get(AI_MATKEY_METALLIC_FACTOR, material.metalness);
  material.roughness = std::clamp(material.roughness, 0.05F, 1.0F);
  material.metalness = std::clamp(material.metalness, 0.0F, 1.0F);
  aiString texture;
  if (from.GetTexture(aiTextureType_BASE_COLOR, 0, &texture) != AI_SUCCESS &&
      from.GetTexture(aiTextureType_DIFFUSE, 0, &texture) != AI_SUCCESS) {
    return;
  }
  mesh.texture = load_texture(texture.C_Str(), source);
  // An .obj file's Kd is often 0 or grey beside a texture that is the whole colour.
  if (mesh.texture != nullptr && !source.gltf) material.base_color = Color::Ones();
}

Eigen::Matrix4f matrix_of(const aiMatrix4x4& m) {
  Eigen::Matrix4f matrix;
  matrix << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2,
      m.d3, m.d4;
  return matrix;
}

void read_vertices(const aiMesh& from, const Eigen::Matrix4f& to_root, Source& source,
                   DrawnMesh& mesh) {
  const Eigen::Matrix3f linear = to_root.topLeftCorner<3, 3>();
  const Eigen::Matrix3f for_normals = linear.inverse().transpose();
  for (unsigned i = 0; i < from.mNumVertices; ++i) {
    const aiVector3D& v = from.mVertices[i];
    mesh.positions.emplace_back(linear * Eigen::Vector3f(v.x, v.y, v.z) +
                                to_root.topRightCorner<3, 1>());
    mesh.sources.push_back(source.vertices++);
    if (from.HasNormals()) {
      const aiVector3D& n = from.mNormals[i];
      mesh.normals.emplace_back((for_normals * Eigen::Vector3f(n.x, n.y, n.z)).normalized());
    }
    if (from.HasVertexColors(0)) mesh.colors.push_back(color_of(from.mColors[0][i], source));
    if (from.HasTextureCoords(0)) {
      // The importer counts from the bottom of the picture.
      mesh.texcoords.emplace_back(from.mTextureCoords[0][i].x, 1.0F - from.mTextureCoords[0][i].y);
    }
  }
}

void append(const aiMesh& from, const Eigen::Matrix4f& to_root, Source& source) {
  DrawnMesh mesh;
  read_vertices(from, to_root, source, mesh);
  const unsigned second = to_root.topLeftCorner<3, 3>().determinant() < 0.0F ? 2 : 1;
  for (unsigned f = 0; f < from.mNumFaces; ++f) {
    const aiFace& face = from.mFaces[f];
    if (face.mNumIndices != 3) continue;
    mesh.triangles.push_back({face.mIndices[0], face.mIndices[second], face.mIndices[3 - second]});
  }
  if (mesh.triangles.empty()) return;
  if (from.mMaterialIndex < source.scene.mNumMaterials) {
    read_material(*source.scene.mMaterials[from.mMaterialIndex], source, mesh);
  }
  // Its own colours are the whole colour where a file has no material to multiply them with.
  if (!mesh.colors.empty() && !source.gltf) mesh.material.base_color = Color::Ones();
  if (mesh.texture == nullptr || mesh.texcoords.empty()) {
    mesh.texture.reset();
    mesh.texcoords.clear();
  }
  const bool usable = std::all_of(mesh.normals.begin(), mesh.normals.end(),
                                  [](const auto& normal) { return normal.allFinite(); });
  if (mesh.normals.empty() || !usable) compute_creased_normals(mesh);
  source.dressed.meshes.push_back(std::move(mesh));
}

void flatten(Source& source) {
  struct PlacedNode {
    const aiNode* node;
    Eigen::Matrix4f to_root;
  };
  const aiNode* const root = source.scene.mRootNode;
  std::vector<PlacedNode> open{{root, matrix_of(root->mTransformation)}};
  while (!open.empty()) {
    const PlacedNode at = open.back();
    open.pop_back();
    for (unsigned i = 0; i < at.node->mNumMeshes; ++i) {
      append(*source.scene.mMeshes[at.node->mMeshes[i]], at.to_root, source);
    }
    for (unsigned i = at.node->mNumChildren; i-- > 0;) {
      const aiNode* const child = at.node->mChildren[i];
      open.push_back({child, at.to_root * matrix_of(child->mTransformation)});
    }
  }
}

}  // namespace

Result<DressedObject> load_drawn_meshes(const std::string& path) {
  const auto unreadable = [&path](const char* why) {
    return Error{ErrorCode::unreadable, fmt::format("{}: cannot be drawn: {}", path, why)};
  };
  try {
    Assimp::Importer importer;
    const aiScene* const scene = importer.ReadFile(path, aiProcess_Triangulate);
    if (scene == nullptr || scene->mRootNode == nullptr) {
      return unreadable(importer.GetErrorString());
    }
    const std::string ending = fs::path(path).extension().string();
    Source source{*scene, path, ending != ".obj" && ending != ".OBJ" && ending != ".ply"};
    flatten(source);
    if (source.dressed.meshes.empty()) return unreadable("expected triangles, found none");
    return std::move(source.dressed);
  } catch (const std::exception& failure) {
    return unreadable(failure.what());
  }
}

}  // namespace nade::draw
