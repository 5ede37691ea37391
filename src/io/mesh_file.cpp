#include "nade/io/mesh_file.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>

#include "gltf_accessor.h"
#include "mesh_formats.h"

namespace nade {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 6> kEndings{".glb", ".gltf", ".obj", ".stl", ".ply", ".off"};
constexpr std::string_view kPlacePrefix = "place-";

Error refuse(ErrorCode code, const std::string& path, std::string_view what) {
  return Error{code, fmt::format("{}: {}", path, what)};
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The library's message as one line without a full stop.
std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool space = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!space) {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  while (!line.empty() && (line.back() == ' ' || line.back() == '.')) line.pop_back();
  return line.empty() ? "no reason given" : line;
}

/// What can be told before the file is parsed.
std::optional<Error> refuse_early(const std::string& path) {
  const std::string ending = lower_case(fs::path(path).extension().string());
  if (std::find(kEndings.begin(), kEndings.end(), ending) == kEndings.end()) {
    return refuse(ErrorCode::bad_format, path,
                  "expected a mesh file ending in .glb .gltf .obj .stl .ply or .off");
  }
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  if (status.type() == fs::file_type::not_found) {
    return refuse(ErrorCode::not_found, path, "no such file");
  }
  if (fs::is_directory(status)) {
    return refuse(ErrorCode::unreadable, path, "expected a mesh file, found a directory");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) return refuse(ErrorCode::unreadable, path, "cannot be opened for reading");
  if (file.peek() == std::ifstream::traits_type::eof()) {
    return refuse(ErrorCode::bad_format, path, "expected a mesh, found an empty file");
  }
  return std::nullopt;
}

/// The first corner beyond its mesh's vertices, before anything follows it.
std::optional<Error> check_indices(const aiScene& scene, const std::string& path) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        if (face.mIndices[k] < mesh.mNumVertices) continue;
        return refuse(ErrorCode::bad_value, path,
                      fmt::format("mesh {}: face {}: expected vertices below {}, found {}", m, f,
                                  mesh.mNumVertices, face.mIndices[k]));
      }
    }
  }
  return std::nullopt;
}

Eigen::Matrix4d matrix_of(const aiMatrix4x4& m) {
  Eigen::Matrix4f matrix;
  matrix << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2,
      m.d3, m.d4;
  return matrix.cast<double>();
}

void append(const aiMesh& mesh, const Eigen::Matrix4d& to_root, TriangleSoup& soup) {
  const auto offset = static_cast<std::uint32_t>(soup.vertices.size());
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& v = mesh.mVertices[i];
    const Eigen::Vector4d at = to_root * Eigen::Vector4f(v.x, v.y, v.z, 1.0F).cast<double>();
    soup.vertices.emplace_back(at.head<3>().cast<float>());
  }
  // A mirroring transform turns triangles inside out.
  const bool mirrored = to_root.topLeftCorner<3, 3>().determinant() < 0.0;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices != 3) continue;
    const unsigned second = mirrored ? 2 : 1;
    soup.triangles.push_back({offset + face.mIndices[0], offset + face.mIndices[second],
                              offset + face.mIndices[3 - second]});
  }
}

std::optional<MeshPlace> place_of(const aiNode& node, const Eigen::Matrix4d& to_root) {
  const std::string_view name(node.mName.C_Str(), node.mName.length);
  if (node.mNumMeshes != 0 || !name.starts_with(kPlacePrefix)) return std::nullopt;
  const Vec3 up = to_root.block<3, 1>(0, 1);
  const Vec3 back = to_root.block<3, 1>(0, 2);
  const Vec3 right = up.cross(back);
  if (!to_root.allFinite() || !(right.norm() > 0.0)) return std::nullopt;
  // Up is what matters most, so it is kept and the stroke's way made square to it.
  Eigen::Matrix3d axes;
  axes.col(0) = right.normalized();
  axes.col(1) = up.normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  MeshPlace place;
  place.name = name.substr(kPlacePrefix.size());
  place.pose = {to_root.block<3, 1>(0, 3), Quat(axes).normalized()};
  return place;
}

struct PlacedNode {
  const aiNode* node;
  Eigen::Matrix4d to_root;
};

MeshFile flatten(const aiScene& scene) {
  MeshFile file;
  std::vector<PlacedNode> open{{scene.mRootNode, matrix_of(scene.mRootNode->mTransformation)}};
  while (!open.empty()) {
    const PlacedNode at = open.back();
    open.pop_back();
    for (unsigned i = 0; i < at.node->mNumMeshes; ++i) {
      append(*scene.mMeshes[at.node->mMeshes[i]], at.to_root, file.soup);
    }
    if (std::optional<MeshPlace> place = place_of(*at.node, at.to_root)) {
      file.places.push_back(std::move(*place));
    }
    for (unsigned i = at.node->mNumChildren; i-- > 0;) {
      const aiNode* child = at.node->mChildren[i];
      open.push_back({child, at.to_root * matrix_of(child->mTransformation)});
    }
  }
  return file;
}

/// The importer leaves out faces with corners that are not there, and says nothing.
std::optional<Error> check_gltf(const std::string& path) {
  const Result<tinygltf::Model> model = gltf::read_model(path);
  if (!model.ok()) return model.error();
  for (std::size_t m = 0; m < model->meshes.size(); ++m) {
    for (const tinygltf::Primitive& primitive : model->meshes[m].primitives) {
      const auto position = primitive.attributes.find("POSITION");
      if (primitive.indices < 0 || position == primitive.attributes.end()) continue;
      const auto at = static_cast<std::size_t>(position->second);
      if (at >= model->accessors.size()) continue;
      const auto indices = gltf::read_integers({*model, path, "indices", primitive.indices}, 1);
      if (!indices.ok()) return indices.error();
      const std::size_t count = model->accessors[at].count;
      for (const std::uint32_t index : *indices) {
        if (index < count) continue;
        return refuse(
            ErrorCode::bad_value, path,
            fmt::format("mesh {}: expected vertices below {}, found {}", m, count, index));
      }
    }
  }
  return std::nullopt;
}

/// .glb, .gltf and .obj.
Result<MeshFile> import_scene(const std::string& path) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path, 0);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    return refuse(
        ErrorCode::bad_format, path,
        "expected a mesh, found what cannot be read: " + one_line(importer.GetErrorString()));
  }
  if (std::optional<Error> error = check_indices(*scene, path)) return *error;
  const auto has_polygons = [](const aiScene& all) {
    return std::any_of(all.mMeshes, all.mMeshes + all.mNumMeshes, [](const aiMesh* mesh) {
      return (mesh->mPrimitiveTypes & aiPrimitiveType_POLYGON) != 0;
    });
  };
  if (has_polygons(*scene)) scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (scene == nullptr) {
    return refuse(ErrorCode::bad_format, path,
                  "cannot be cut into triangles: " + one_line(importer.GetErrorString()));
  }
  return flatten(*scene);
}

Result<MeshFile> parse(const std::string& path) {
  const std::string ending = lower_case(fs::path(path).extension().string());
  if (ending == ".glb" || ending == ".gltf") {
    if (std::optional<Error> error = check_gltf(path)) return *error;
    return import_scene(path);
  }
  if (ending == ".obj") return import_scene(path);
  std::ifstream file(path, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) return refuse(ErrorCode::unreadable, path, "cannot be read to its end");
  const io::MeshText text{path, content};
  Result<TriangleSoup> soup = ending == ".off"   ? io::read_off(text)
                              : ending == ".ply" ? io::read_ply(text)
                                                 : io::read_stl(text);
  if (!soup.ok()) return soup.error();
  return MeshFile{std::move(*soup), {}};
}

Result<MeshFile> check(MeshFile file, const std::string& path) {
  if (file.soup.triangles.empty()) {
    return refuse(ErrorCode::bad_value, path, "expected triangles, found none");
  }
  for (std::size_t i = 0; i < file.soup.vertices.size(); ++i) {
    if (!file.soup.vertices[i].allFinite()) {
      return refuse(ErrorCode::bad_value, path,
                    fmt::format("vertex {}: expected finite coordinates", i));
    }
  }
  return file;
}

}  // namespace

Result<MeshFile> load_mesh(const std::string& path) {
  if (std::optional<Error> error = refuse_early(path)) return *error;
  try {
    Result<MeshFile> file = parse(path);
    return file.ok() ? check(std::move(*file), path) : file;
  } catch (const std::exception& failure) {
    return refuse(ErrorCode::unreadable, path, "cannot be read: " + one_line(failure.what()));
  }
}

}  // namespace nade
