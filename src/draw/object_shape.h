#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "nade/dent.h"
#include "nade/draw/renderer.h"
#include "nade/io/object_file.h"

namespace nade::draw {

/// The shape of the object that is drawn, as it moves by itself and gives way under skin.
class ObjectShape {
 public:
  void clear();
  /// One of the object's meshes, as it was taken to the renderer: the object at rest.
  void add(MeshId id, const DrawnMesh& mesh);

  /// Follows an object that moves by itself.
  void follow(const LoadedObject& object);

  /// Skin lies in the object, world coordinates; it is called for each hand.
  void press(const Object& object, std::span<const Eigen::Vector3f> skin);

  /// Takes what has changed since the last time to the renderer. The object, which stands at
  /// `placement`, gives way to the skin so far, by no more than `deepest_m`.
  void update(Renderer& renderer, const Placement& placement, double deepest_m);

 private:
  struct Part {
    MeshId id{};
    std::vector<Eigen::Vector3f> file_normals;
    std::vector<Eigen::Vector3f> rest_normals;  ///< as `triangles` have them
    std::vector<Eigen::Vector3f> base;          ///< before it gives way
    std::vector<Eigen::Vector3f> positions;
    std::vector<Eigen::Vector3f> normals;
    std::vector<std::uint32_t> sources;
    std::vector<std::array<std::uint32_t, 3>> triangles;
  };
  void show(Part& part, Renderer& renderer);

  std::vector<Part> parts_;
  double longest_edge_m_ = 0.0;
  std::optional<std::uint64_t> shape_;  ///< the object's, as last followed
  bool moved_ = false;                  ///< since it was last shown
  bool dented_ = false;                 ///< as last shown
  std::vector<DentSpot> spots_;
  std::size_t spot_count_ = 0;
};

}  // namespace nade::draw
