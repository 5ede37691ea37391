#pragma once

#include <array>
#include <cstdint>

#include "nade/draw/scene.h"
#include "nade/geometry.h"
#include "nade/hand.h"
#include "nade/status.h"

namespace nade::test {

/// A hand as Monado's remote driver takes it: where its wrist is, and how far each finger is
/// curled.
struct RemoteHand {
  bool tracked = false;
  Pose grip;
  std::array<float, kDigitCount> curl{};  ///< 0 stretched, 1 a fist
};

/// Everything the driver is told: it makes up a headset and hands from it.
struct RemoteState {
  Pose head;
  std::array<draw::FieldOfView, 2> views{};
  std::array<Pose, 2> eyes{};         ///< against the head
  std::array<RemoteHand, 2> hands{};  ///< by index_of(Handedness)
};

/// A connection to the remote driver of a Monado service on this machine.
class RemoteDriver {
 public:
  /// Tries for some seconds. The error says that nobody answers.
  [[nodiscard]] static Result<RemoteDriver> connect(std::uint16_t port);
  RemoteDriver(RemoteDriver&& other) noexcept;
  RemoteDriver& operator=(RemoteDriver&& other) noexcept;
  ~RemoteDriver();

  /// False once the service has gone.
  [[nodiscard]] bool send(const RemoteState& state);

 private:
  explicit RemoteDriver(int socket) : socket_(socket) {}
  int socket_ = -1;
};

/// A person of 1.7 m who looks at what is before them, seen by a headset whose eyes see more
/// outward than inward.
[[nodiscard]] RemoteState looking_down();

/// Where the driver has to be told the hand is so that the palm's joint is at a pose.
[[nodiscard]] Pose grip_for_palm(Handedness side, const Pose& palm);
/// A hand that points with its index finger, the tip's joint at a point, turned like `turn`: ahead
/// is -Z.
[[nodiscard]] RemoteHand pointing(Handedness side, const Vec3& tip, const Quat& turn);

}  // namespace nade::test
