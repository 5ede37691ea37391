#pragma once

#include "nade.h"
#include "nade/surface.h"

namespace nade::c_abi {

/// A surface by a program's callbacks. Answers that are no numbers, or too far away, count as none.
class CustomSurface final : public Surface {
 public:
  explicit CustomSurface(const nade_surface_callbacks& callbacks);
  CustomSurface(const CustomSurface&) = delete;
  CustomSurface& operator=(const CustomSurface&) = delete;
  ~CustomSurface() override;

  /// From here on the program's `release` is called in the end.
  void own() noexcept { owns_ = true; }

  [[nodiscard]] std::optional<RayHit> first_hit(const Ray& ray) const noexcept override;
  [[nodiscard]] std::optional<SurfacePoint> closest_point(
      const Vec3& query, double max_distance, SurfaceHint& hint) const noexcept override;
  [[nodiscard]] std::uint64_t shape() const noexcept override;
  [[nodiscard]] std::optional<SurfaceBounds> bounds() const noexcept override;

 private:
  [[nodiscard]] std::optional<RayHit> hit_by_steps(const Ray& ray) const noexcept;

  nade_surface_callbacks callbacks_;
  std::uint64_t number_;  ///< no other surface's
  bool owns_ = false;
};

}  // namespace nade::c_abi
