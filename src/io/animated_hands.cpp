#include "animated_hands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

#include "nade/io/assets.h"
#include "nade/io/hand_file.h"
#include "nade/version.h"

namespace nade::io {
namespace {

using ModelJson = nlohmann::ordered_json;
using Place = AnimatedHands::Place;
using Track = AnimatedHands::Track;

// Names and numbers of the glTF specification.
constexpr int kUnsignedByte = 5121;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;
constexpr std::uint32_t kGlbMagic = 0x46546C67;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

Joint joint_of_bone(std::size_t bone) { return joint_at(bone + 1); }
std::size_t bone_of_joint(Joint joint) {
  return index_of(joint == Joint::palm ? Joint::middle_metacarpal : joint) - 1;
}

/// The bone that a bone hangs on in a chain; none for the wrist.
std::optional<std::size_t> parent_of(std::size_t bone) {
  const Joint joint = joint_of_bone(bone);
  if (joint == Joint::wrist) return std::nullopt;
  for (std::size_t i = 0; i < kDigitCount; ++i) {
    if (joint == joint_at(index_of(joints_of(digit_at(i)).tip) - (i == 0 ? 3 : 4))) {
      return bone_of_joint(Joint::wrist);
    }
  }
  return bone - 1;
}

Pose as_pose(const Place& place) {
  const auto& at = place.position;
  const auto& turn = place.rotation;
  return {{at[0], at[1], at[2]}, Quat(turn[3], turn[0], turn[1], turn[2])};
}

Place as_place(const Pose& pose) {
  const Eigen::Vector3f at = pose.position.cast<float>();
  const Eigen::Vector4f turn = pose.rotation.coeffs().cast<float>();
  return {{at.x(), at.y(), at.z()}, {turn.x(), turn.y(), turn.z(), turn.w()}};
}

/// Where a bone is against what it hangs on, in lengths of a hand of its mesh's size.
Pose local_pose(const std::array<Place, AnimatedHands::kBones>& places, std::size_t bone,
                bool chained, double scale) {
  const Pose world = as_pose(places[bone]);
  const auto parent = chained ? parent_of(bone) : std::nullopt;
  if (!parent) return {world.position / scale, world.rotation};
  const Pose from = as_pose(places[*parent]);
  return {from.rotation.conjugate() * (world.position - from.position) / scale,
          (from.rotation.conjugate() * world.rotation).normalized()};
}

/// The file's binary part, and what the JSON part says of it.
class ModelBuffer {
 public:
  /// An accessor of `count` elements that lie one behind the other in `values`.
  template <class Value>
  int add(std::span<const Value> values, const char* type, std::size_t count, int component,
          const char* target = "") {
    while (bytes_.size() % 4 != 0) bytes_ += '\0';
    ModelJson view{
        {"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size_bytes()}};
    if (std::strcmp(target, "vertices") == 0) view["target"] = 34962;
    if (std::strcmp(target, "indices") == 0) view["target"] = 34963;
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    views.push_back(std::move(view));
    accessors.push_back({{"bufferView", views.size() - 1},
                         {"componentType", component},
                         {"count", count},
                         {"type", type}});
    return static_cast<int>(accessors.size()) - 1;
  }

  /// The same with its bounds, which times and positions have to have.
  int add_bounded(std::span<const float> values, const char* type, std::size_t numbers,
                  const char* target = "") {
    const int accessor = add(values, type, values.size() / numbers, kFloat, target);
    std::vector<float> low(numbers, std::numeric_limits<float>::max());
    std::vector<float> high(numbers, std::numeric_limits<float>::lowest());
    for (std::size_t i = 0; i < values.size(); ++i) {
      low[i % numbers] = std::min(low[i % numbers], values[i]);
      high[i % numbers] = std::max(high[i % numbers], values[i]);
    }
    ModelJson& json = accessors[static_cast<std::size_t>(accessor)];
    json["min"] = low;
    json["max"] = high;
    return accessor;
  }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

  ModelJson views = ModelJson::array();
  ModelJson accessors = ModelJson::array();

 private:
  std::string bytes_;
};

std::span<const float> floats_of(const std::vector<Eigen::Vector3f>& vectors) {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  return {reinterpret_cast<const float*>(vectors.data()), 3 * vectors.size()};
}

/// Puts the model together.
class ModelBuilder {
 public:
  explicit ModelBuilder(const ModelOptions& options) : options_(options) {
    json_["scene"] = 0;
    for (const char* key : {"scenes", "nodes", "meshes", "materials"}) {
      json_[key] = ModelJson::array();
    }
    json_["scenes"].push_back({{"nodes", ModelJson::array()}});
  }

  void add_hand(const Track& track, std::span<const float> all_times_s);
  void add_object(const TriangleSoup& soup);
  Result<std::string> finish(const std::string& header_json);

 private:
  std::size_t add_to(const char* list, ModelJson entry) {
    json_[list].push_back(std::move(entry));
    return json_[list].size() - 1;
  }
  std::size_t add_skin_mesh(const HandMesh& mesh, const std::string& name);
  std::size_t add_skin(const HandMesh& mesh, std::size_t first_joint);
  void add_bones(const Track& track, double scale, std::size_t first_joint);
  void animate(std::size_t node, const char* path, int times, int values, const char* way);
  void animate_bones(const Track& track, double scale, std::size_t first_joint);
  void animate_presence(const Track& track, std::span<const float> all_times_s, double scale,
                        std::size_t node);

  const ModelOptions& options_;
  ModelJson json_;
  ModelJson samplers_ = ModelJson::array();
  ModelJson channels_ = ModelJson::array();
  ModelBuffer buffer_;
};

double median_of(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

void ModelBuilder::add_hand(const Track& track, std::span<const float> all_times_s) {
  const double scale = median_of(track.scales);
  const std::string name = fmt::format("{}-hand", name_of(track.mesh.side));
  const std::size_t hand =
      add_to("nodes",
             {{"name", name}, {"scale", {scale, scale, scale}}, {"children", ModelJson::array()}});
  if (!track.contacts.empty()) json_["nodes"][hand]["extras"]["contacts"] = track.contacts;
  const std::size_t first = json_["nodes"].size();
  add_bones(track, scale, first);
  const std::size_t mesh = add_skin_mesh(track.mesh, name);
  const std::size_t skin = add_skin(track.mesh, first);
  const std::size_t shown =
      add_to("nodes", {{"name", fmt::format("{}-skin", name)}, {"mesh", mesh}, {"skin", skin}});
  ModelJson& children = json_["nodes"][hand]["children"];
  for (std::size_t bone = 0; bone < AnimatedHands::kBones; ++bone) {
    if (!options_.chained || !parent_of(bone)) children.push_back(first + bone);
  }
  children.push_back(shown);
  json_["scenes"][0]["nodes"].push_back(hand);
  animate_bones(track, scale, first);
  animate_presence(track, all_times_s, scale, hand);
}

/// The joints as they stand in the bind pose.
void ModelBuilder::add_bones(const Track& track, double scale, std::size_t first_joint) {
  std::array<Place, AnimatedHands::kBones> bind{};
  for (std::size_t bone = 0; bone < bind.size(); ++bone) {
    Pose pose = track.mesh.bind[joint_of_bone(bone)];
    pose.position *= scale;
    bind[bone] = as_place(pose);
  }
  for (std::size_t bone = 0; bone < bind.size(); ++bone) {
    const Place place = as_place(local_pose(bind, bone, options_.chained, scale));
    add_to("nodes", {{"name", webxr_name_of(joint_of_bone(bone))},
                     {"translation", place.position},
                     {"rotation", place.rotation}});
  }
  if (!options_.chained) return;
  for (std::size_t bone = 0; bone < bind.size(); ++bone) {
    if (const auto parent = parent_of(bone)) {
      json_["nodes"][first_joint + *parent]["children"].push_back(first_joint + bone);
    }
  }
}

std::size_t ModelBuilder::add_skin_mesh(const HandMesh& mesh, const std::string& name) {
  std::vector<std::array<std::uint8_t, 4>> bones;
  for (const auto& of_vertex : mesh.bones) {
    std::array<std::uint8_t, 4> mapped{};
    for (std::size_t k = 0; k < mapped.size(); ++k) {
      mapped[k] = static_cast<std::uint8_t>(bone_of_joint(joint_at(of_vertex[k])));
    }
    bones.push_back(mapped);
  }
  const std::size_t count = mesh.vertices.size();
  const ModelJson attributes{
      {"POSITION", buffer_.add_bounded(floats_of(mesh.vertices), "VEC3", 3, "vertices")},
      {"NORMAL", buffer_.add(floats_of(mesh.normals), "VEC3", count, kFloat, "vertices")},
      {"JOINTS_0", buffer_.add(std::span<const std::array<std::uint8_t, 4>>(bones), "VEC4", count,
                               kUnsignedByte, "vertices")},
      {"WEIGHTS_0", buffer_.add(std::span<const std::array<float, 4>>(mesh.weights), "VEC4", count,
                                kFloat, "vertices")}};
  const int indices = buffer_.add(std::span<const std::array<std::uint32_t, 3>>(mesh.triangles),
                                  "SCALAR", 3 * mesh.triangles.size(), kUnsignedInt, "indices");
  const std::size_t material = add_to("materials", {{"name", name},
                                                    {"pbrMetallicRoughness",
                                                     {{"baseColorFactor", {0.8, 0.6, 0.5, 1.0}},
                                                      {"metallicFactor", 0.0},
                                                      {"roughnessFactor", 0.6}}}});
  return add_to("meshes",
                {{"name", name},
                 {"primitives",
                  {{{"attributes", attributes}, {"indices", indices}, {"material", material}}}}});
}

std::size_t ModelBuilder::add_skin(const HandMesh& mesh, std::size_t first_joint) {
  std::vector<Eigen::Matrix4f> inverse_bind;
  ModelJson joints = ModelJson::array();
  for (std::size_t bone = 0; bone < AnimatedHands::kBones; ++bone) {
    const Pose& pose = mesh.bind[joint_of_bone(bone)];
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() = pose.rotation.conjugate().toRotationMatrix();
    matrix.topRightCorner<3, 1>() = -(pose.rotation.conjugate() * pose.position);
    inverse_bind.push_back(matrix.cast<float>());
    joints.push_back(first_joint + bone);
  }
  const std::span<const float> numbers(inverse_bind.front().data(), 16 * inverse_bind.size());
  const int matrices = buffer_.add(numbers, "MAT4", inverse_bind.size(), kFloat);
  return add_to("skins", {{"inverseBindMatrices", matrices}, {"joints", joints}});
}

void ModelBuilder::animate(std::size_t node, const char* path, int times, int values,
                           const char* way) {
  samplers_.push_back({{"input", times}, {"output", values}, {"interpolation", way}});
  channels_.push_back(
      {{"sampler", samplers_.size() - 1}, {"target", {{"node", node}, {"path", path}}}});
}

void ModelBuilder::animate_bones(const Track& track, double scale, std::size_t first_joint) {
  const int times = buffer_.add_bounded(track.times_s, "SCALAR", 1);
  const std::size_t count = track.times_s.size();
  std::vector<std::array<float, 3>> positions(count);
  std::vector<std::array<float, 4>> rotations(count);
  for (std::size_t bone = 0; bone < AnimatedHands::kBones; ++bone) {
    Quat before = Quat::Identity();
    for (std::size_t i = 0; i < count; ++i) {
      Pose pose = local_pose(track.places[i], bone, options_.chained, scale);
      // Of the two quaternions of a turn the one that is nearer to the last.
      if (i > 0 && pose.rotation.dot(before) < 0.0) pose.rotation.coeffs() *= -1.0;
      before = pose.rotation;
      const Place place = as_place(pose);
      positions[i] = place.position;
      rotations[i] = place.rotation;
    }
    animate(first_joint + bone, "translation", times,
            buffer_.add(std::span<const std::array<float, 3>>(positions), "VEC3", count, kFloat),
            "LINEAR");
    animate(first_joint + bone, "rotation", times,
            buffer_.add(std::span<const std::array<float, 4>>(rotations), "VEC4", count, kFloat),
            "LINEAR");
  }
}

/// A hand that is missing in some frames has no size there.
void ModelBuilder::animate_presence(const Track& track, std::span<const float> all_times_s,
                                    double scale, std::size_t node) {
  std::vector<float> times;
  std::vector<float> sizes;
  const auto add = [&](float time_s, bool there) {
    times.push_back(time_s);
    sizes.insert(sizes.end(), 3, there ? static_cast<float>(scale) : 0.0F);
  };
  if (track.times_s.front() > all_times_s.front()) add(all_times_s.front(), false);
  for (const std::size_t first : track.begins) {
    if (first > 0) {
      const float last_s = track.times_s[first - 1];
      add(*std::upper_bound(all_times_s.begin(), all_times_s.end(), last_s), false);
    }
    add(track.times_s[first], true);
  }
  const float last_s = track.times_s.back();
  if (last_s < all_times_s.back()) {
    add(*std::upper_bound(all_times_s.begin(), all_times_s.end(), last_s), false);
  }
  if (times.size() < 2) return;
  animate(node, "scale", buffer_.add_bounded(times, "SCALAR", 1),
          buffer_.add(std::span<const float>(sizes), "VEC3", times.size(), kFloat), "STEP");
}

void ModelBuilder::add_object(const TriangleSoup& soup) {
  const ModelJson attributes{
      {"POSITION", buffer_.add_bounded(floats_of(soup.vertices), "VEC3", 3, "vertices")}};
  const int indices = buffer_.add(std::span<const std::array<std::uint32_t, 3>>(soup.triangles),
                                  "SCALAR", 3 * soup.triangles.size(), kUnsignedInt, "indices");
  const std::size_t material = add_to("materials", {{"name", "object"},
                                                    {"doubleSided", true},
                                                    {"pbrMetallicRoughness",
                                                     {{"baseColorFactor", {0.6, 0.6, 0.6, 1.0}},
                                                      {"metallicFactor", 0.0},
                                                      {"roughnessFactor", 0.9}}}});
  const std::size_t mesh = add_to(
      "meshes", {{"name", "object"},
                 {"primitives",
                  {{{"attributes", attributes}, {"indices", indices}, {"material", material}}}}});
  json_["scenes"][0]["nodes"].push_back(add_to("nodes", {{"name", "object"}, {"mesh", mesh}}));
}

void append_number(std::string& bytes, std::uint32_t number) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(number >> shift & 0xFFU);
}

void append_chunk(std::string& bytes, std::uint32_t kind, std::string content, char filler) {
  while (content.size() % 4 != 0) content += filler;
  append_number(bytes, static_cast<std::uint32_t>(content.size()));
  append_number(bytes, kind);
  bytes += content;
}

Result<std::string> ModelBuilder::finish(const std::string& header_json) {
  ModelJson model{{"asset",
                   {{"version", "2.0"},
                    {"generator", fmt::format("nade {}", NADE_VERSION)},
                    {"extras", {{"recording", ModelJson::parse(header_json)}}}}}};
  // The specification has no empty arrays.
  for (const auto& [key, value] : json_.items()) {
    if (!value.empty() || value.is_number()) model[key] = value;
  }
  if (!channels_.empty()) {
    model["animations"] = {
        {{"name", "recording"}, {"samplers", samplers_}, {"channels", channels_}}};
  }
  if (!buffer_.bytes().empty()) {
    model["accessors"] = buffer_.accessors;
    model["bufferViews"] = buffer_.views;
    model["buffers"] = {{{"byteLength", buffer_.bytes().size()}}};
  }
  std::string body;
  append_chunk(body, kJsonChunk, model.dump(-1, ' ', false, ModelJson::error_handler_t::replace),
               ' ');
  constexpr std::size_t kHead = 12;
  if (body.size() + buffer_.bytes().size() + 2 * kHead >
      std::numeric_limits<std::uint32_t>::max()) {
    return Error{ErrorCode::unwritable,
                 "expected at most 4 GiB of a .glb, found a longer recording"};
  }
  if (!buffer_.bytes().empty()) append_chunk(body, kBinaryChunk, buffer_.bytes(), '\0');
  std::string file;
  append_number(file, kGlbMagic);
  append_number(file, 2);
  append_number(file, static_cast<std::uint32_t>(kHead + body.size()));
  file += body;
  return file;
}

ModelJson json_of(const Vec3& vector) { return {vector.x(), vector.y(), vector.z()}; }

void add_contact_of(ModelJson& contacts, Part part, float time_s, const RecordedContact& contact) {
  ModelJson& of_part = contacts[std::string(name_of(part))];
  of_part["time_s"].push_back(time_s);
  of_part["point"].push_back(json_of(contact.point));
  of_part["normal"].push_back(json_of(contact.normal));
  of_part["depth_m"].push_back(contact.depth_m);
}

}  // namespace

bool names_a_model(const std::string& path) { return content_ending_of(path) == ".glb"; }

Result<AnimatedHands> AnimatedHands::create(const RecordingHeader& header,
                                            const ModelOptions& options) {
  AnimatedHands hands;
  hands.options_ = options;
  hands.header_json_ = header.unknown_json.empty() ? "{}" : header.unknown_json;
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const Result<std::string> path = find_asset(fmt::format("hands/{}.glb", name_of(side)));
    if (!path) return path.error();
    Result<HandMesh> mesh = load_hand_mesh(*path, side);
    if (!mesh) return mesh.error();
    hands.tracks_[index_of(side)].mesh = std::move(mesh).value();
  }
  return hands;
}

void AnimatedHands::add(const RecordedFrame& frame) {
  if (!first_ns_) first_ns_ = frame.time_ns;
  const auto time_s = static_cast<float>(1e-9 * static_cast<double>(frame.time_ns - *first_ns_));
  times_s_.push_back(time_s);
  for (std::size_t side = 0; side < tracks_.size(); ++side) {
    Track& track = tracks_[side];
    const std::optional<RecordedHand>& hand = frame.hands[side];
    if (hand) {
      if (!seen_before_[side]) track.begins.push_back(track.times_s.size());
      track.times_s.push_back(time_s);
      track.scales.push_back(static_cast<float>(hand_scale(track.mesh, hand->pose)));
      std::array<Place, kBones>& places = track.places.emplace_back();
      for (std::size_t bone = 0; bone < kBones; ++bone) {
        places[bone] = as_place(hand->pose[joint_of_bone(bone)]);
      }
      for (std::size_t i = 0; i < kPartCount; ++i) {
        if (const auto& contact = hand->contact[i]) {
          add_contact_of(track.contacts, part_at(i), time_s, *contact);
        }
      }
    }
    seen_before_[side] = hand.has_value();
  }
}

Result<std::string> AnimatedHands::as_glb() const {
  ModelBuilder builder(options_);
  for (const Track& track : tracks_) {
    if (!track.times_s.empty()) builder.add_hand(track, times_s_);
  }
  if (options_.object && !options_.object->triangles.empty()) builder.add_object(*options_.object);
  return builder.finish(header_json_);
}

}  // namespace nade::io
