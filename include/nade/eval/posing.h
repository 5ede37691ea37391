#pragma once

#include <array>

#include "nade/hand.h"
#include "nade/skeleton.h"
#include "nade/surface.h"

namespace nade {

/// How a hand is held, on top of how it was relaxed.
struct HandShape {
  double curl = 0.0;    ///< of the four fingers: 0 as relaxed, 1 bent by 45 degrees more
  double spread = 0.0;  ///< of all digits: 0 as relaxed, 1 apart by about 10 degrees each
};

/// A relaxed hand that can be bent and put onto a surface: what synthetic strokes and hands
/// without a tracker are made from. Its palm joint is the origin, unturned.
class PosableHand {
 public:
  /// `relaxed` is of either side; one of the other side is mirrored. `scale` > 0 times its size.
  PosableHand(const HandPose& relaxed, Handedness side, double scale);

  [[nodiscard]] const HandPose& relaxed() const { return hand_; }
  /// From the palm joint to the palm's skin, metres.
  [[nodiscard]] double palm_skin_depth_m() const { return palm_skin_depth_m_; }

  /// The hand in a shape, and with flexions and abductions added to that.
  [[nodiscard]] HandPose posed(const HandShape& shape, const HandAngles& added = {}) const;

  /// Where the palm joint is when the palm's skin is at `skin` and the hand is turned so.
  [[nodiscard]] Pose palm_at(const Vec3& skin, const Quat& rotation) const {
    return {skin + palm_skin_depth_m_ * (rotation * Vec3::UnitY()), rotation};
  }

 private:
  HandPose hand_;
  std::array<DigitChain, kDigitCount> chains_{};
  double palm_skin_depth_m_ = 0.0;
};

/// The surface's normal about a point, averaged over a palm's breadth: how a flat hand lies
/// there. `otherwise` where no surface is within 10 cm.
[[nodiscard]] Vec3 broad_normal(const Object& object, const Vec3& point, const Vec3& otherwise);

}  // namespace nade
