#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "make_dog_mesh.h"

namespace dog {

/// A bone of the living dog; at rest none is turned or scaled.
struct Bone {
  std::string name;
  Vec3 position;  ///< of its joint at rest
  std::optional<std::size_t> parent;
};

/// What the bones do at a moment.
struct BonePose {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Vec3 scale = Vec3::Ones();
};

/// Up to four bones that carry a vertex; the weights sum to 1.
struct Carriers {
  std::array<std::uint8_t, 4> bone{};
  std::array<float, 4> weight{};
};

/// How the dog lives: it breathes, looks around and wags its tail, over and over.
inline constexpr double kLifeSeconds = 6.0;

/// Parents first.
[[nodiscard]] const std::vector<Bone>& bones();

/// Which bones carry a point of the surface, smoothly over the body.
[[nodiscard]] Carriers carriers_of(const Vec3& point);

/// What every bone does at a time; at 0 and at `kLifeSeconds` nothing: the dog is as at rest.
[[nodiscard]] std::vector<BonePose> life_at(double time_s);

/// What keeps the living dog from being stroked: a triangle that folds over or tears; nothing
/// where all is well.
[[nodiscard]] std::optional<std::string> life_defect(const Mesh& mesh);

}  // namespace dog
