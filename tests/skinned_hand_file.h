#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "nade/hand.h"

namespace nade::test {

/// A .gltf file with one skinned triangle and the joints of a flat right hand: what a user's own
/// hand may look like, with one thing wrong at a time.
struct SkinnedHandFile {
  double unit = 1.0;  ///< of the mesh; the bind matrices make metres of it
  std::array<float, 4> weights{1.0F, 0.0F, 0.0F, 0.0F};
  std::optional<Joint> misnamed;
  bool has_extra_bone = false;
  std::optional<Joint> extra_bone_parent;  ///< bears all weights

  /// Fingers forward (-Z), back up, thumb to the left.
  [[nodiscard]] static Vec3 joint(Joint which) {
    if (which == Joint::wrist || which == Joint::palm) return Vec3::Zero();
    constexpr std::array<double, kDigitCount> kSide{-0.03, -0.02, 0.0, 0.02, 0.04};
    std::size_t digit = 0;
    while (index_of(joints_of(digit_at(digit)).tip) < index_of(which)) ++digit;
    const auto step =
        static_cast<double>(index_of(which) - index_of(joints_of(digit_at(digit)).metacarpal));
    return {kSide[digit], 0.0, -0.03 - 0.03 * step};
  }

  [[nodiscard]] nlohmann::json gltf() const {
    std::string bytes;
    const auto append = [&bytes](const auto& values) {
      const std::size_t start = bytes.size();
      const std::size_t size = values.size() * sizeof(values[0]);
      bytes.resize(start + (size + 3) / 4 * 4);
      std::memcpy(bytes.data() + start, values.data(), size);
      return nlohmann::json{{"buffer", 0}, {"byteOffset", start}, {"byteLength", size}};
    };
    const auto u = static_cast<float>(unit);
    const bool extra = has_extra_bone || extra_bone_parent.has_value();
    const std::uint8_t bone = extra ? 25 : 0;
    std::vector<float> all_weights;
    for (int i = 0; i < 3; ++i) {
      all_weights.insert(all_weights.end(), weights.begin(), weights.end());
    }
    nlohmann::json views = nlohmann::json::array();
    views.push_back(append(std::vector<float>{0, 0, 0, 0.01F * u, 0, 0, 0, 0, -0.01F * u}));
    const auto second = static_cast<std::uint8_t>(extra ? 25 : 1);
    views.push_back(append(
        std::vector<std::uint8_t>{bone, second, 0, 0, bone, second, 0, 0, bone, second, 0, 0}));
    views.push_back(append(all_weights));
    views.push_back(append(std::vector<std::uint16_t>{0, 1, 2}));
    views.push_back(append(inverse_binds(extra)));
    return {
        {"asset", {{"version", "2.0"}}},
        {"buffers",
         {{{"byteLength", bytes.size()},
           {"uri", "data:application/octet-stream;base64," + base64(bytes)}}}},
        {"bufferViews", views},
        {"accessors",
         {accessor(0, 5126, 3, "VEC3"), accessor(1, 5121, 3, "VEC4"), accessor(2, 5126, 3, "VEC4"),
          accessor(3, 5123, 3, "SCALAR"), accessor(4, 5126, extra ? 26 : 25, "MAT4")}},
        {"meshes",
         {{{"primitives",
            {{{"attributes", {{"POSITION", 0}, {"JOINTS_0", 1}, {"WEIGHTS_0", 2}}},
              {"indices", 3}}}}}}},
        {"nodes", nodes(extra)},
        {"skins", {{{"joints", skin_joints(extra)}, {"inverseBindMatrices", 4}}}}};
  }

  /// Writes it under the test's own folder and returns where.
  [[nodiscard]] std::string write(const std::string& name) const { return write(name, gltf()); }
  [[nodiscard]] static std::string write(const std::string& name, const nlohmann::json& gltf) {
    std::string path = testing::TempDir() + "nade_hand_" + name + ".gltf";
    std::ofstream(path) << gltf.dump();
    return path;
  }

 private:
  [[nodiscard]] std::vector<float> inverse_binds(bool extra) const {
    std::vector<float> matrices;
    for (std::size_t i = 1; i < kJointCount + (extra ? 1 : 0); ++i) {
      const Vec3 p = i < kJointCount ? joint(joint_at(i)) : Vec3(Vec3::Zero());
      const auto s = static_cast<float>(1.0 / unit);
      const std::array<float, 16> matrix{s,
                                         0,
                                         0,
                                         0,
                                         0,
                                         s,
                                         0,
                                         0,
                                         0,
                                         0,
                                         s,
                                         0,
                                         static_cast<float>(-p.x()),
                                         static_cast<float>(-p.y()),
                                         static_cast<float>(-p.z()),
                                         1};
      matrices.insert(matrices.end(), matrix.begin(), matrix.end());
    }
    return matrices;
  }

  [[nodiscard]] static std::string webxr_name(Joint which) {
    std::string name(name_of(which));
    const std::size_t split = name.find('_');
    if (split == std::string::npos) return name;
    std::string digit = name.substr(0, split);
    const std::string part = name.substr(split + 1);
    if (digit == "little") digit = "pinky";
    if (digit != "thumb") digit += "-finger";
    return digit + (part == "tip" || part == "metacarpal" ? "-" : "-phalanx-") + part;
  }

  /// The mesh's node, the 25 joints, then the extra bone.
  [[nodiscard]] nlohmann::json nodes(bool extra) const {
    nlohmann::json all = nlohmann::json::array();
    all.push_back({{"mesh", 0}, {"skin", 0}});
    for (std::size_t i = 1; i < kJointCount; ++i) {
      const Joint which = joint_at(i);
      nlohmann::json node{{"name", which == misnamed ? "bone" : webxr_name(which)}};
      if (which == extra_bone_parent) node["children"] = {26};
      all.push_back(node);
    }
    if (extra) all.push_back({{"name", "pad"}});
    return all;
  }

  [[nodiscard]] static nlohmann::json skin_joints(bool extra) {
    nlohmann::json all = nlohmann::json::array();
    for (std::size_t node = 1; node < kJointCount + (extra ? 1 : 0); ++node) all.push_back(node);
    return all;
  }

  [[nodiscard]] static nlohmann::json accessor(int view, int component, int count,
                                               const char* type) {
    return {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}};
  }

  [[nodiscard]] static std::string base64(const std::string& bytes) {
    constexpr const char* kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      std::uint32_t group = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = i + k;
        group = group << 8U | (at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0U);
      }
      for (std::size_t k = 0; k < 4; ++k) {
        text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63U];
      }
    }
    return text;
  }
};

}  // namespace nade::test
