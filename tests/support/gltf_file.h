#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace nade::test {

/// A .gltf file with one triangle, changed and moved as a test says.
class GltfFile {
 public:
  explicit GltfFile(const std::string& name)
      : path_((std::filesystem::path(testing::TempDir()) / (name + ".gltf")).string()) {
    gltf = nlohmann::json::parse(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
      "nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
      "accessors":[],"bufferViews":[],
      "animations":[{"name":"sway","channels":[],"samplers":[]}]})");
    add({0, 0, 0, 1, 0, 0, 0, 0, -1}, "VEC3");
    add_bytes(std::vector<std::uint16_t>{0, 1, 2}, 5123, "SCALAR", 3);
  }

  int add(const std::vector<float>& numbers, const std::string& type) {
    const std::size_t width = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
    return add_bytes(numbers, 5126, type, numbers.size() / width);
  }

  template <class Number>
  int add_bytes(const std::vector<Number>& numbers, int component, const std::string& type,
                std::size_t count) {
    const std::size_t start = bytes_.size();
    const std::size_t size = numbers.size() * sizeof(Number);
    bytes_.resize(start + (size + 3) / 4 * 4);
    std::memcpy(bytes_.data() + start, numbers.data(), size);
    gltf["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", start}, {"byteLength", size}});
    gltf["accessors"].push_back({{"bufferView", gltf["bufferViews"].size() - 1},
                                 {"componentType", component},
                                 {"type", type},
                                 {"count", count}});
    return static_cast<int>(gltf["accessors"].size()) - 1;
  }

  /// Moves a property of a node.
  void animate(int node, const std::string& property, const std::string& interpolation,
               const std::vector<float>& times, const std::vector<float>& values) {
    const std::string type = property == "rotation"  ? "VEC4"
                             : property == "weights" ? "SCALAR"
                                                     : "VEC3";
    nlohmann::json& animation = gltf["animations"][0];
    animation["samplers"].push_back({{"input", add(times, "SCALAR")},
                                     {"output", add(values, type)},
                                     {"interpolation", interpolation}});
    animation["channels"].push_back({{"sampler", animation["samplers"].size() - 1},
                                     {"target", {{"node", node}, {"path", property}}}});
  }

  /// Writes it; its path.
  const std::string& write() {
    const std::string bin = path_ + ".bin";
    std::ofstream(bin, std::ios::binary) << bytes_;
    gltf["buffers"] = {
        {{"byteLength", bytes_.size()}, {"uri", std::filesystem::path(bin).filename().string()}}};
    std::ofstream(path_) << gltf.dump();
    return path_;
  }

  nlohmann::json gltf;

 private:
  std::string path_;
  std::string bytes_;
};

}  // namespace nade::test
