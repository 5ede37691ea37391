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

#include "mesh_formats.h"
#include "obj_text.h"
#include "whole_file.h"

namespace nade {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 6> kEndings{".glb", ".gltf", ".obj", ".stl", ".ply", ".off"};

Error refuse(ErrorCode code, const std::string& path, std::string_view what) {
  return Error{code, fmt::format("{}: {}", path, what)};
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
  if (!has_mesh_ending(path)) {
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

TriangleSoup soup_of(const aiScene& scene) {
  TriangleSoup soup;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& v = mesh.mVertices[i];
      soup.vertices.emplace_back(v.x, v.y, v.z);
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      soup.triangles.push_back(
          {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    }
  }
  return soup;
}

Result<TriangleSoup> read_obj(const std::string& path) {
  Assimp::Importer importer;
  if (const Status status = io::read_as_plain_obj(importer, path); !status) return status.error();
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
  return soup_of(*scene);
}

Result<TriangleSoup> read_plain(const std::string& path, std::string_view ending) {
  const Result<std::string> content = io::read_whole(path);
  if (!content) return content.error();
  const io::MeshText text{path, *content};
  if (ending == ".off") return io::read_off(text);
  return ending == ".ply" ? io::read_ply(text) : io::read_stl(text);
}

Result<MeshFile> parse(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".glb" || ending == ".gltf") return io::read_gltf(path);
  Result<TriangleSoup> soup = ending == ".obj" ? read_obj(path) : read_plain(path, ending);
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

std::string ending_of(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

bool has_mesh_ending(const std::string& path) {
  return std::find(kEndings.begin(), kEndings.end(), ending_of(path)) != kEndings.end();
}

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
