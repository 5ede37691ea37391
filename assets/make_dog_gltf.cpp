#include "make_dog_gltf.h"

#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <system_error>

#include "make_dog_life.h"

// Based on: The Khronos Group. glTF 2.0 Specification. 2021.

namespace dog {
namespace {

constexpr int kLifeKeys = 96;

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
    accessor.count = values.size() / static_cast<std::size_t>(tinygltf::GetNumComponentsInType(
                                         static_cast<std::uint32_t>(type)));
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  void set_range(int accessor, std::vector<double> low, std::vector<double> high) {
    tinygltf::Accessor& of = model_.accessors[static_cast<std::size_t>(accessor)];
    of.minValues = std::move(low);
    of.maxValues = std::move(high);
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

/// Which bones carry each vertex.
void add_carriers(const Mesh& mesh, Packer& packer, tinygltf::Primitive& primitive) {
  std::vector<std::uint8_t> joints;
  std::vector<float> weights;
  for (const Vec3& point : mesh.points) {
    const Carriers carriers = carriers_of(point);
    joints.insert(joints.end(), carriers.bone.begin(), carriers.bone.end());
    weights.insert(weights.end(), carriers.weight.begin(), carriers.weight.end());
  }
  constexpr int kVertices = TINYGLTF_TARGET_ARRAY_BUFFER;
  primitive.attributes["JOINTS_0"] =
      packer.add(joints, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_VEC4, kVertices);
  primitive.attributes["WEIGHTS_0"] =
      packer.add(weights, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4, kVertices);
}

tinygltf::Primitive add_primitive(tinygltf::Model& model, Packer& packer, const Body& body,
                                  const Mesh& mesh) {
  std::vector<Vec3> normals;
  std::vector<Vec3> colors;
  for (const Vec3& point : mesh.points) {
    normals.push_back(body.sample(point).gradient.normalized());
    colors.push_back(coat_color(body, point).unaryExpr(&linear_from_srgb));
  }
  std::vector<std::uint32_t> indices;
  for (const auto& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());

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
  add_carriers(mesh, packer, primitive);
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

/// Appends the bones as nodes, hung into one another; the skin that they make.
tinygltf::Skin add_bones(tinygltf::Model& model, Packer& packer) {
  const auto first = static_cast<int>(model.nodes.size());
  tinygltf::Skin skin;
  skin.name = "dog";
  skin.skeleton = first;
  std::vector<float> inverse_binds;
  for (std::size_t i = 0; i < bones().size(); ++i) {
    const Bone& bone = bones()[i];
    tinygltf::Node node;
    node.name = bone.name;
    Vec3 offset = bone.position;
    if (bone.parent) {
      offset -= bones()[*bone.parent].position;
      model.nodes[static_cast<std::size_t>(first) + *bone.parent].children.push_back(
          first + static_cast<int>(i));
    }
    node.translation = {offset.x(), offset.y(), offset.z()};
    model.nodes.push_back(node);
    skin.joints.push_back(first + static_cast<int>(i));
    Eigen::Matrix4f inverse = Eigen::Matrix4f::Identity();
    inverse.topRightCorner<3, 1>() = -bone.position.cast<float>();
    inverse_binds.insert(inverse_binds.end(), inverse.data(), inverse.data() + inverse.size());
  }
  skin.inverseBindMatrices =
      packer.add(inverse_binds, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_MAT4, 0);
  return skin;
}

/// The keys of one property of one bone: tangent in, value, tangent out.
template <class Get>
std::vector<float> spline_keys(std::size_t bone, const Get& get) {
  constexpr double kStep = 1e-4;
  std::vector<float> keys;
  const auto append = [&keys](const auto& numbers) {
    for (Eigen::Index i = 0; i < numbers.size(); ++i)
      keys.push_back(static_cast<float>(numbers[i]));
  };
  for (int key = 0; key <= kLifeKeys; ++key) {
    const double time_s = kLifeSeconds * key / kLifeKeys;
    const auto value = get(life_at(time_s)[bone]);
    const auto tangent =
        ((get(life_at(time_s + kStep)[bone]) - get(life_at(time_s - kStep)[bone])) / (2.0 * kStep))
            .eval();
    append(tangent);
    append(value);
    append(tangent);
  }
  return keys;
}

tinygltf::Animation make_life(Packer& packer, const tinygltf::Skin& skin) {
  tinygltf::Animation life;
  life.name = "alive";
  std::vector<float> times;
  for (int key = 0; key <= kLifeKeys; ++key) {
    times.push_back(static_cast<float>(kLifeSeconds * key / kLifeKeys));
  }
  const int input = packer.add(times, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, 0);
  packer.set_range(input, {0.0}, {kLifeSeconds});
  for (std::size_t i = 1; i < bones().size(); ++i) {  // the hips stay
    const bool breathes = bones()[i].name == "chest";
    const auto scale = [](const BonePose& pose) -> Eigen::Vector3d { return pose.scale; };
    const auto turn = [](const BonePose& pose) -> Eigen::Vector4d {
      return pose.rotation.coeffs();
    };
    tinygltf::AnimationSampler sampler;
    sampler.input = input;
    sampler.output = breathes ? packer.add(spline_keys(i, scale), TINYGLTF_COMPONENT_TYPE_FLOAT,
                                           TINYGLTF_TYPE_VEC3, 0)
                              : packer.add(spline_keys(i, turn), TINYGLTF_COMPONENT_TYPE_FLOAT,
                                           TINYGLTF_TYPE_VEC4, 0);
    sampler.interpolation = "CUBICSPLINE";
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(life.samplers.size());
    channel.target_node = skin.joints[i];
    channel.target_path = breathes ? "scale" : "rotation";
    life.samplers.push_back(sampler);
    life.channels.push_back(channel);
  }
  return life;
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
  Packer packer(model);
  surface.primitives.push_back(add_primitive(model, packer, body, mesh));
  model.meshes.push_back(surface);
  tinygltf::Node node;
  node.name = "dog";
  node.mesh = 0;
  node.skin = 0;
  model.nodes.push_back(node);
  for (const Place& place : places) model.nodes.push_back(place_node(place));
  tinygltf::Scene scene;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) scene.nodes.push_back(static_cast<int>(i));
  scene.nodes.push_back(static_cast<int>(model.nodes.size()));  // the hips, and all on them
  model.skins.push_back(add_bones(model, packer));
  model.animations.push_back(make_life(packer, model.skins.front()));
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
