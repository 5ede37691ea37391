#include <fmt/format.h>
#include <stb/stb_image.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "gltf_rig.h"
#include "object_look.h"

// Based on: The Khronos Group. glTF 2.0 Specification. 2021 (materials; colours are linear light).

namespace nade::draw {
namespace {

using Vec3f = Eigen::Vector3f;

const Color kNoMaterial(0.7F, 0.7F, 0.7F);

/// Of an attribute, `width` numbers a vertex; none where it is absent, or too short.
std::vector<float> attribute(const tinygltf::Model& model, const std::string& path,
                             const gltf::Piece& piece, const std::string& name, int width) {
  const auto& attributes = model.meshes[piece.mesh].primitives[piece.primitive].attributes;
  const auto found = attributes.find(name);
  if (found == attributes.end()) return {};
  auto numbers = gltf::read_floats({model, path, name.c_str(), found->second}, width);
  const std::size_t needed = static_cast<std::size_t>(width) * piece.positions.size();
  return numbers.ok() && numbers->size() == needed ? std::move(*numbers) : std::vector<float>();
}

Vec3f vector_at(const std::vector<float>& numbers, std::size_t i, std::size_t width = 3) {
  return {numbers[width * i], numbers[width * i + 1], numbers[width * i + 2]};
}

/// Pixels that a file's pictures may have together, and more for each byte of its buffers: a
/// picture of one colour has a thousand pixels to a byte.
constexpr std::size_t kFreePixels = 48'000'000;
constexpr std::size_t kPixelsPerByte = 16;

/// PNG or JPEG, of no more pixels than are left, which it lessens.
std::optional<Image> decode_picture(const std::string& bytes, std::size_t& pixels_left) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) return std::nullopt;
  const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  Image image;
  if (stbi_info_from_memory(data, size, &image.width, &image.height, nullptr) == 0) {
    return std::nullopt;
  }
  const std::size_t count =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (count > pixels_left) return std::nullopt;
  pixels_left -= count;
  stbi_uc* const pixels =
      stbi_load_from_memory(data, size, &image.width, &image.height, nullptr, 4);
  if (pixels == nullptr) return std::nullopt;
  image.rgba.assign(pixels, pixels + 4 * std::ptrdiff_t{image.width} * image.height);
  stbi_image_free(pixels);
  return image;
}

/// A file while it is taken over.
class Wardrobe {
 public:
  Wardrobe(const tinygltf::Model& model, const std::string& path, gltf::Rig rig)
      : model_(model), path_(path), rig_(std::move(rig)) {
    for (const tinygltf::Buffer& buffer : model.buffers) {
      pixels_left_ += kPixelsPerByte * buffer.data.size();
    }
  }

  DressedObject dressed() {
    std::vector<Vec3f> at_normals(rig_.vertex_count());
    std::vector<Vec3f> vertices(rig_.vertex_count());
    std::vector<std::vector<float>> normals;
    gltf::Rig raised = rig_;
    for (gltf::Piece& piece : raised.pieces) {
      normals.push_back(attribute(model_, path_, piece, "NORMAL", 3));
      for (std::size_t i = 0; i < normals.back().size() / 3; ++i) {
        piece.positions[i] += vector_at(normals.back(), i);
      }
    }
    gltf::pose_vertices(raised, at_normals);
    gltf::pose_vertices(rig_, vertices);
    std::uint32_t first = 0;
    for (std::size_t p = 0; p < rig_.pieces.size(); ++p) {
      add(rig_.pieces[p], normals[p], first, vertices, at_normals);
      first += static_cast<std::uint32_t>(rig_.pieces[p].positions.size());
    }
    return std::move(dressed_);
  }

 private:
  void add(const gltf::Piece& piece, const std::vector<float>& normals, std::uint32_t first,
           const std::vector<Vec3f>& vertices, const std::vector<Vec3f>& at_normals) {
    DrawnMesh mesh;
    mesh.triangles = gltf::triangles_of(rig_, piece);
    if (mesh.triangles.empty()) return;
    const Eigen::Matrix3f linear = rig_.worlds[piece.node].topLeftCorner<3, 3>().cast<float>();
    const Eigen::Matrix3f for_normals = linear.inverse().transpose();
    for (std::uint32_t i = 0; i < piece.positions.size(); ++i) {
      mesh.positions.push_back(vertices[first + i]);
      mesh.sources.push_back(first + i);
      if (normals.empty()) continue;
      // Bones carry a normal as they carry what lies between two points.
      const Vec3f normal = piece.skin ? Vec3f(at_normals[first + i] - vertices[first + i])
                                      : Vec3f(for_normals * vector_at(normals, i));
      mesh.normals.push_back(normal.normalized());
    }
    paint(piece, mesh);
    const bool usable = std::all_of(mesh.normals.begin(), mesh.normals.end(),
                                    [](const Vec3f& normal) { return normal.allFinite(); });
    if (mesh.normals.empty() || !usable) compute_creased_normals(mesh);
    dressed_.meshes.push_back(std::move(mesh));
  }

  void paint(const gltf::Piece& piece, DrawnMesh& mesh) {
    for (const int width : {3, 4}) {
      const std::vector<float> colors = attribute(model_, path_, piece, "COLOR_0", width);
      for (std::size_t i = 0; i < colors.size() / static_cast<std::size_t>(width); ++i) {
        mesh.colors.emplace_back(vector_at(colors, i, static_cast<std::size_t>(width)));
      }
    }
    const int index = model_.meshes[piece.mesh].primitives[piece.primitive].material;
    if (index < 0 || static_cast<std::size_t>(index) >= model_.materials.size()) {
      mesh.material.base_color = mesh.colors.empty() ? kNoMaterial : Color(Color::Ones());
      return;
    }
    const auto& from = model_.materials[static_cast<std::size_t>(index)].pbrMetallicRoughness;
    if (from.baseColorFactor.size() >= 3) {
      mesh.material.base_color =
          Eigen::Map<const Eigen::Vector3d>(from.baseColorFactor.data()).cast<float>();
    }
    mesh.material.roughness = std::clamp(static_cast<float>(from.roughnessFactor), 0.05F, 1.0F);
    mesh.material.metalness = std::clamp(static_cast<float>(from.metallicFactor), 0.0F, 1.0F);
    const std::vector<float> places = attribute(
        model_, path_, piece, fmt::format("TEXCOORD_{}", from.baseColorTexture.texCoord), 2);
    if (places.empty()) return;
    mesh.texture = texture(from.baseColorTexture.index);
    if (mesh.texture == nullptr) return;
    for (std::size_t i = 0; i + 1 < places.size(); i += 2) {
      mesh.texcoords.emplace_back(places[i], places[i + 1]);
    }
  }

  std::shared_ptr<const Image> texture(int index) {
    if (index < 0 || static_cast<std::size_t>(index) >= model_.textures.size()) return nullptr;
    const int source = model_.textures[static_cast<std::size_t>(index)].source;
    if (source < 0 || static_cast<std::size_t>(source) >= model_.images.size()) return nullptr;
    const auto [known, is_new] = textures_.try_emplace(source);
    if (is_new) known->second = decoded(source);
    return known->second;
  }

  std::shared_ptr<const Image> decoded(int source) {
    const Result<std::string> bytes =
        gltf::read_picture(model_, path_, static_cast<std::size_t>(source));
    if (!bytes) {
      dressed_.warnings.push_back(bytes.error().message + ", so it is not shown");
      return nullptr;
    }
    std::optional<Image> image = decode_picture(*bytes, pixels_left_);
    if (image) return std::make_shared<const Image>(std::move(*image));
    dressed_.warnings.push_back(fmt::format(
        "{}: texture {}: expected a PNG or JPEG picture, so it is not shown", path_, source));
    return nullptr;
  }

  const tinygltf::Model& model_;
  const std::string& path_;
  gltf::Rig rig_;
  std::map<int, std::shared_ptr<const Image>> textures_;
  std::size_t pixels_left_ = kFreePixels;
  DressedObject dressed_;
};

}  // namespace

Result<DressedObject> load_gltf_meshes(const std::string& path) {
  const Result<tinygltf::Model> model = gltf::read_model(path);
  if (!model) return model.error();
  Result<gltf::Rig> rig = gltf::read_rig(*model, path);
  if (!rig) return rig.error();
  DressedObject dressed = Wardrobe(*model, path, std::move(*rig)).dressed();
  if (!dressed.meshes.empty()) return dressed;
  return Error{ErrorCode::unreadable,
               fmt::format("{}: cannot be drawn: expected triangles, found none", path)};
}

}  // namespace nade::draw
