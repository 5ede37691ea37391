#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "nade/contact.h"
#include "nade/corrector.h"
#include "nade/flesh.h"
#include "nade/settle_options.h"
#include "nade/surface.h"
#include "surface/near_objects.h"
#include "tuning.h"

namespace nade {

struct ProxyState;

/// The skin of a bone that touches.
struct BoneContact {
  Joint bone = Joint::palm;
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitY();
  double depth_m = 0.0;
  SurfaceHint hint;  ///< of the query that found the surface there
};

/// The hand as it rests on the surface.
struct ProxyResult {
  HandPose hand;  ///< bit for bit the tracked one where nothing is to be corrected
  Contacts contacts{};
  std::array<BoneContact, kMostSkinContacts> bones;
  std::size_t bone_count = 0;
  bool touches = false;    ///< or hovers for a moment over what is pressed in
  bool corrected = false;  ///< or touched until just now: the hand is not the tracked one
};

/// The hand that is drawn: it follows the tracked one as if coupled by springs, rests on the
/// object's surface with flesh that gives, and is drawn to it where the person presses.
class ProxyHand {
 public:
  /// `flesh` has to outlive it.
  ProxyHand(const HandFlesh& flesh, const ProxyTuning& tuning);
  ProxyHand(ProxyHand&&) noexcept;
  ProxyHand& operator=(ProxyHand&&) noexcept;
  ~ProxyHand();

  /// The next frame. `scale` is the tracked hand's size over the flesh's, `seconds` the time since
  /// the last frame, `around` what became since of the objects that are one surface with this one.
  /// Never allocates or throws.
  [[nodiscard]] ProxyResult update(const HandPose& tracked, double scale, const Object& object,
                                   const Rearrangement& around, double seconds,
                                   const SettleOptions& options) noexcept;

  /// The next frame's hand was not seen for long: nothing is known of it.
  void forget() noexcept;

 private:
  const HandFlesh* flesh_;
  ProxyTuning tuning_;
  std::unique_ptr<ProxyState> state_;
};

}  // namespace nade
