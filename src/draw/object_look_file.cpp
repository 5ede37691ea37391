#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <exception>
#include <filesystem>
#include <map>

#include "mesh_words.h"
#include "nade/io/mesh_file.h"
#include "obj_text.h"
#include "object_look.h"
#include "whole_file.h"

namespace nade::draw {
namespace {

namespace fs = std::filesystem;

/// Has one file's content in memory, and opens only what lies below its folder.
class OneInMemory : public Assimp::DefaultIOSystem {
 public:
  OneInMemory(std::string path, std::string content)
      : path_(std::move(path)), content_(std::move(content)) {}

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (file != path_) {
      return io::is_below_folder_of(path_, file) ? DefaultIOSystem::Open(file, mode) : nullptr;
    }
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(content_.data());
    return new Assimp::MemoryIOStream(bytes, content_.size());
  }

 private:
  std::string path_;
  std::string content_;
};

/// A file while it is taken over.
struct Source {
  const aiScene& scene;
  std::string path;
  std::map<std::string, std::shared_ptr<const Image>> textures{};
  DressedObject dressed{};
};

std::shared_ptr<const Image> load_texture(const std::string& name, Source& source) {
  const auto known = source.textures.find(name);
  if (known != source.textures.end()) return known->second;
  std::shared_ptr<const Image>& texture = source.textures[name];
  std::string file = name;
  std::replace(file.begin(), file.end(), '\\', '/');
  file = (fs::path(source.path).parent_path() / file).string();
  const Result<Image> image =
      io::is_below_folder_of(source.path, file)
          ? load_image(file)
          : Error{ErrorCode::bad_value, fmt::format("'{}' lies outside its folder", name)};
  if (image) {
    texture = std::make_shared<const Image>(*image);
  } else {
    source.dressed.warnings.push_back(
        fmt::format("{}: its texture is not shown: {}", source.path, image.error().message));
  }
  return texture;
}

Color color_of(const aiColor4D& color) { return from_srgb({color.r, color.g, color.b}); }

void read_material(const aiMaterial& from, Source& source, DrawnMesh& mesh) {
  Material& material = mesh.material;
  aiColor4D color(0.7F, 0.7F, 0.7F, 1.0F);
  if (from.Get(AI_MATKEY_BASE_COLOR, color) != AI_SUCCESS) {
    from.Get(AI_MATKEY_COLOR_DIFFUSE, color);
  }
  material.base_color = color_of(color);
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
  if (mesh.texture != nullptr) material.base_color = Color::Ones();
}

void read_vertices(const aiMesh& from, DrawnMesh& mesh) {
  for (unsigned i = 0; i < from.mNumVertices; ++i) {
    mesh.positions.emplace_back(from.mVertices[i].x, from.mVertices[i].y, from.mVertices[i].z);
    if (from.HasNormals()) {
      const aiVector3D& n = from.mNormals[i];
      mesh.normals.emplace_back(Eigen::Vector3f(n.x, n.y, n.z).normalized());
    }
    if (from.HasVertexColors(0)) mesh.colors.push_back(color_of(from.mColors[0][i]));
    if (from.HasTextureCoords(0)) {
      // The importer counts from the bottom of the picture.
      mesh.texcoords.emplace_back(from.mTextureCoords[0][i].x, 1.0F - from.mTextureCoords[0][i].y);
    }
  }
}

void append(const aiMesh& from, Source& source) {
  DrawnMesh mesh;
  read_vertices(from, mesh);
  TriangleSoup soup{std::move(mesh.positions), {}};
  for (unsigned f = 0; f < from.mNumFaces; ++f) {
    const aiFace& face = from.mFaces[f];
    // One that is too winding is missing then, which the count tells.
    if (!io::add_polygon(soup, {face.mIndices, face.mNumIndices})) return;
  }
  mesh.positions = std::move(soup.vertices);
  mesh.triangles = std::move(soup.triangles);
  if (mesh.triangles.empty()) return;
  if (from.mMaterialIndex < source.scene.mNumMaterials) {
    read_material(*source.scene.mMaterials[from.mMaterialIndex], source, mesh);
  }
  // Its own colours are the whole colour where a file has no material to multiply them with.
  if (!mesh.colors.empty()) mesh.material.base_color = Color::Ones();
  if (mesh.texture == nullptr || mesh.texcoords.empty()) {
    mesh.texture.reset();
    mesh.texcoords.clear();
  }
  const bool usable = std::all_of(mesh.normals.begin(), mesh.normals.end(),
                                  [](const auto& normal) { return normal.allFinite(); });
  if (mesh.normals.empty() || !usable) compute_creased_normals(mesh);
  source.dressed.meshes.push_back(std::move(mesh));
}

}  // namespace

Result<DressedObject> load_plain_meshes(const std::string& path) {
  const auto unreadable = [&path](const char* why) {
    return Error{ErrorCode::unreadable, fmt::format("{}: cannot be drawn: {}", path, why)};
  };
  try {
    Assimp::Importer importer;
    if (ending_of(path) == ".obj") {
      Result<std::string> plain = io::plain_obj(path);
      if (!plain) return plain.error();
      importer.SetIOHandler(new OneInMemory(path, std::move(*plain)));  // which it deletes
    }
    const aiScene* const scene = importer.ReadFile(path, 0);
    if (scene == nullptr || scene->mRootNode == nullptr) {
      return unreadable(importer.GetErrorString());
    }
    Source source{*scene, path};
    for (unsigned m = 0; m < scene->mNumMeshes; ++m) append(*scene->mMeshes[m], source);
    if (source.dressed.meshes.empty()) return unreadable("expected triangles, found none");
    return std::move(source.dressed);
  } catch (const std::exception& failure) {
    return unreadable(failure.what());
  }
}

}  // namespace nade::draw
