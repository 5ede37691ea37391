#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "contact_term.h"
#include "nade/correction.h"
#include "nade/flesh.h"
#include "nade/surface.h"
#include "pad_plane.h"
#include "solver.h"
#include "surface/near_objects.h"
#include "tracking/clock.h"
#include "tracking/glitch.h"
#include "tracking/object_frame.h"

namespace nade {

/// What a drawn hand is doing. docs/method.md draws how one follows from the other.
enum class ProxyMode : std::uint8_t {
  lost,       ///< no hand was seen: the next is found anew
  free,       ///< drawn as it is tracked, or on its way there with nothing in the way
  contact,    ///< the object holds it, and the person presses
  blocked,    ///< the object holds it up, the person is elsewhere
  returning,  ///< let go: it fades to where the person is
};

/// A frame as it was settled.
struct SettledFrame {
  HandPose tracked;
  HandPose drawn;
  Correction correction;
};

/// How the hand touches the surface; along the object's axes.
struct SurfaceTouch {
  Vec3 normal = Vec3::Zero();  ///< unit, of the surface under what is drawn to it; zero in the air
  double height_m = 0.0;       ///< of the drawn palm over the tracked one along it
  double deepest_m = -1.0;     ///< of the tracked palmar skin below the surface
  double air_s = 0.0;          ///< how long nothing has held the hand
  double softness_m = 0.0;     ///< of the object, smoothed
  double softness_depth_m = 0.02;
  Vec3 lag = Vec3::Zero();        ///< along the surface, by friction
  Vec3 drawn_lag = Vec3::Zero();  ///< the same, smoothed
  bool slips = false;
};

/// A frame after which the tracked hand jumped.
struct FrameBeforeJump {
  SettledFrame frame;
  SurfaceTouch touch;
  ProxyMode mode = ProxyMode::lost;
};

/// What was seen of a deforming surface near a joint of the drawn hand.
struct SurfaceWatch {
  SurfaceHint hint;
  std::optional<SurfacePoint> before;  ///< in the last frame's shape
};
inline constexpr std::size_t kSurfaceWatches = 7;

/// How a hand was drawn in the last frame, in the axes of where the object is now, and how far the
/// tracked one has come since by itself.
struct ShownBefore {
  Correction correction;
  double way_m = 0.0;
};

/// A hand that was let go, on its way from one correction to another.
struct Return {
  HandFreedoms from = HandFreedoms::Zero();  ///< what it had more, along the object's axes
  double left = 0.0;                         ///< of that, 1 to 0
  double elapsed_s = std::numeric_limits<double>::infinity();
  double lasts_s = 1.0;
};

/// What a proxy hand remembers from frame to frame, in the object's frame and in the world's
/// lengths, and room to work in. A copy would lack that room.
struct ProxyState {
  explicit ProxyState(const HandFlesh& flesh);

  // The filter in front.
  TrackerClock clock;
  TrackedMotion motion;
  std::array<FrameBeforeJump, std::tuple_size_v<decltype(TrackedMotion::jumps_from)>> before_jumps;

  // The object.
  ObjectFrame object;
  std::uint64_t shape = 0;    ///< the surface's
  double scale = 1.0;         ///< the object's
  double undeformed_s = 0.0;  ///< how long both have been the same
  std::array<SurfaceWatch, kSurfaceWatches> watches;

  // The hand.
  ProxyMode mode = ProxyMode::lost;
  std::optional<SettledFrame> last;
  Correction shown;                ///< the last one as drawn, which may be on its way there
  JointVectors offset_velocity{};  ///< of the drawn joints against the tracked ones, m/s
  SurfaceTouch touch;
  double clear_s = 0.0;  ///< how long the tracked hand is clear of the object, the drawn one far
  double stuck_s = 0.0;  ///< how long it presses elsewhere
  Return returning;

  // The surface near its pads.
  std::vector<PadMemory> pads;
  JointVectors joints{};        ///< of the hand as looked at last
  double travel_m = 0.0;        ///< the sum of what its farthest joint went from look to look
  double way_m = 0.0;           ///< and of what the tracked hand's went from frame to frame
  std::size_t last_inside = 0;  ///< the pad whose tracked skin was last found in the object

  std::vector<ContactTerm> terms;
  SolverRoom room;
};

/// What is known of the last frame goes on in this one's place, whichever object it is at; of
/// another one's surface nothing is known, unless that was near and is the carrier now.
/// Gives how it was drawn, of a hand that was seen then and did not jump.
std::optional<ShownBefore> go_on(const SeenHand& seen, const Object& object,
                                 const std::optional<CarrierBefore>& carrier,
                                 ProxyState& state) noexcept;
/// Takes in whether the tracked hand jumped since the last frame, or back to where it was.
[[nodiscard]] bool follow_jump(const HandPose& tracked, double seconds, ProxyState& state) noexcept;
/// The surface has another shape: what its pads saw does not count.
void forget_planes(ProxyState& state) noexcept;
/// An object beside the carrier moved, deformed, came or went: what it may have to do with does
/// not count of what the pads saw.
void forget_near(const NearChange& change, double hand_radius_m, ProxyState& state) noexcept;
/// The surface is another's: nothing is known of it.
void forget_surface(ProxyState& state) noexcept;
/// The hand is found anew. It may still jump back to where it was.
void forget_frame(ProxyState& state) noexcept;

}  // namespace nade
