#include "make_dog_gltf.h"

#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <system_error>

// Based on: The Khronos Group. glTF 2.0 Specification. 2021.

namespace dog {
namespace {

/// glTF vertex colours are linear.
double linear_from_srgb(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

class Packer {
 public:
  explicit Packer(tinygltf::Model& model) : model_(model) { model_.buffers.emplace_back(); }

  /// Appends the values as one buffer view with one accessor; its index.
  template <class Value>
  int add(const std::vector<Value>& values, int component, int type, int target) {
    auto& data = model_.buffers.front().data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = values.size() * sizeof(Value);
    view.target = target;
    data.resize(data.size() + view.byteLength);
    std::memcpy(data.data() + view.byteOffset, values.data(), view.byteLength);
    model_.bufferViews.push_back(view);
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
    accessor.componentType = component;
    accessor.type = type;
    const std::size_t each = type == TINYGLTF_TYPE_VEC3 ? 3 : 1;
    accessor.count = each == 1 ? values.size() : values.size() / each;
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

 private:
  tinygltf::Model& model_;
};

std::vector<float> flatten(const std::vector<Vec3>& points) {
  std::vector<float> result;
  for (const Vec3& p : points)
    for (int axis = 0; axis < 3; ++axis) result.push_back(static_cast<float>(p[axis]));
  return result;
}

tinygltf::Primitive add_primitive(tinygltf::Model& model, const Body& body, const Mesh& mesh) {
  std::vector<Vec3> normals;
  std::vector<Vec3> colors;
  for (const Vec3& point : mesh.points) {
    normals.push_back(body.sample(point).gradient.normalized());
    colors.push_back(coat_color(body, point).unaryExpr(&linear_from_srgb));
  }
  std::vector<std::uint32_t> indices;
  for (const auto& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());

  Packer packer(model);
  constexpr int kFloat = TINYGLTF_COMPONENT_TYPE_FLOAT;
  constexpr int kVertices = TINYGLTF_TARGET_ARRAY_BUFFER;
  tinygltf::Primitive primitive;
  const std::vector<float> positions = flatten(mesh.points);
  primitive.attributes["POSITION"] = packer.add(positions, kFloat, TINYGLTF_TYPE_VEC3, kVertices);
  auto& accessor = model.accessors.back();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float low = positions[axis];
    float high = low;
    for (std::size_t i = axis; i < positions.size(); i += 3) {
      low = std::min(low, positions[i]);
      high = std::max(high, positions[i]);
    }
    accessor.minValues.push_back(low);
    accessor.maxValues.push_back(high);
  }
  primitive.attributes["NORMAL"] =
      packer.add(flatten(normals), kFloat, TINYGLTF_TYPE_VEC3, kVertices);
  primitive.attributes["COLOR_0"] =
      packer.add(flatten(colors), kFloat, TINYGLTF_TYPE_VEC3, kVertices);
  primitive.indices = packer.add(indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                 TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = 0;
  return primitive;
}

tinygltf::Node place_node(const Place& place) {
  Eigen::Matrix3d axes;
  axes.col(1) = place.normal;
  axes.col(2) = -place.direction;
  axes.col(0) = axes.col(1).cross(axes.col(2));
  const Eigen::Quaterniond q(axes);
  tinygltf::Node node;
  node.name = place.name;
  node.translation = {place.position.x(), place.position.y(), place.position.z()};
  node.rotation = {q.x(), q.y(), q.z(), q.w()};
  return node;
}

tinygltf::Model make_model(const Body& body, const Mesh& mesh, const std::vector<Place>& places) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "nade make_dog";
  tinygltf::Material coat;
  coat.name = "coat";
  coat.pbrMetallicRoughness.metallicFactor = 0.0;
  coat.pbrMetallicRoughness.roughnessFactor = 0.85;
  model.materials.push_back(coat);
  tinygltf::Mesh surface;
  surface.name = "dog";
  surface.primitives.push_back(add_primitive(model, body, mesh));
  model.meshes.push_back(surface);
  tinygltf::Node node;
  node.name = "dog";
  node.mesh = 0;
  model.nodes.push_back(node);
  for (const Place& place : places) model.nodes.push_back(place_node(place));
  tinygltf::Scene scene;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) scene.nodes.push_back(static_cast<int>(i));
  model.scenes.push_back(scene);
  model.defaultScene = 0;
  return model;
}

}  // namespace

std::optional<std::string> write_glb(const Body& body, const Mesh& mesh,
                                     const std::vector<Place>& places,
                                     const std::filesystem::path& path) {
  const tinygltf::Model model = make_model(body, mesh, places);
  std::filesystem::path unfinished = path;
  unfinished += ".part";
  {
    std::ofstream stream(unfinished, std::ios::binary);
    tinygltf::TinyGLTF writer;
    const bool written = writer.WriteGltfSceneToStream(&model, stream, false, true);
    stream.close();
    if (!written || !stream) {
      std::error_code ignored;
      std::filesystem::remove(unfinished, ignored);
      return unfinished.string() + ": could not be written whole";
    }
  }
  std::error_code error;
  std::filesystem::rename(unfinished, path, error);
  if (error) return path.string() + ": could not be put in place: " + error.message();
  return std::nullopt;
}

}  // namespace dog
