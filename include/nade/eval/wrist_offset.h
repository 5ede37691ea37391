#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "nade/flesh.h"
#include "nade/hand.h"
#include "nade/surface.h"

namespace nade {

/// What programs do that have nothing better, to be compared with: the whole hand is moved out of
/// the object along the surface's normal where it is deepest, until neither the palm's nor a
/// fingertip's skin lies inside; the fingers keep their pose. The side on which the hand came in
/// is remembered, so that it is not let through when pushed deep or through a thin wall.
class WristOffset {
 public:
  /// `scale` is the tracked hand's size over the flesh's, > 0.
  WristOffset(std::shared_ptr<const HandFlesh> flesh, double scale);

  /// The hand in the next frame, bit for bit the tracked one where nothing is to be moved.
  [[nodiscard]] HandPose update(const HandPose& tracked, const Object& object) noexcept;

 private:
  struct Way {
    double length_m = 0.0;
    Vec3 normal = Vec3::UnitY();
  };
  [[nodiscard]] std::optional<Way> deepest(const Object& object) noexcept;
  [[nodiscard]] Way way_out(const Object& object, const Vec3& normal,
                            double reach_m) const noexcept;

  std::shared_ptr<const HandFlesh> flesh_;
  double scale_;
  std::vector<std::size_t> tested_;  ///< of the flesh's skin: palm and fingertips
  std::vector<Vec3> skin_;           ///< of the frame, world
  std::vector<SurfaceHint> hints_;
  std::optional<Vec3> normal_;  ///< unit, while the hand is held out
  double offset_m_ = 0.0;
};

}  // namespace nade
