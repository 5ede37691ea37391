#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "nade/geometry.h"
#include "nade/status.h"

namespace nade {

/// A mesh that moves by itself: what a glTF file's animation makes of its vertices through bones
/// (linear blend skinning), morph targets and moving nodes. Played over and over.
class AnimatedMesh {
 public:
  /// Reads a .glb or .gltf file. `animation` by its name, or the first where that is empty. The
  /// error names the file and what of it cannot be played.
  [[nodiscard]] static Result<AnimatedMesh> load(const std::string& path,
                                                 std::string_view animation = {});
  AnimatedMesh(AnimatedMesh&&) noexcept;
  AnimatedMesh& operator=(AnimatedMesh&&) noexcept;
  ~AnimatedMesh();

  /// As many as `load_mesh` gives, and in its order.
  [[nodiscard]] std::size_t vertex_count() const;
  /// Of one round, seconds; 0 where the animation has one moment only, in which it then stands.
  [[nodiscard]] double duration_s() const;
  /// A sentence where it stands still, with the file's animations that move; else empty.
  [[nodiscard]] const std::string& warning() const;

  /// The vertices at a time since the animation's start, any finite number: it goes round and
  /// round. `vertices` holds `vertex_count()`. Does not allocate. Not from two threads at once.
  void sample(double time_s, std::span<Eigen::Vector3f> vertices) noexcept;

 private:
  struct Impl;
  explicit AnimatedMesh(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace nade
