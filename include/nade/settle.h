#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "nade/contact.h"
#include "nade/correction.h"
#include "nade/flesh.h"

namespace nade {

/// Friction to be seen, not felt: the drawn hand lags the person's along the surface, then slips.
struct VisibleFriction {
  double coefficient = 0.0;     ///< lag over pressing depth at which it slips, 0 (none) to 2
  double kinetic = 0.6;         ///< share of that lag which is left while it slips, 0 to 1
  double longest_lag_m = 0.03;  ///< whatever the depth
};

/// No object is softer.
inline constexpr double kSoftest_m = 0.02;

/// What the object under the hand is like.
struct SettleOptions {
  /// The skin sinks in this far at the most, metres: 0 for a hard object, up to `kSoftest_m`.
  double softness_m = 0.0;
  /// Pressing so deep makes it sink by two thirds of that, metres, above 0.
  double softness_depth_m = 0.02;
  VisibleFriction friction;
};

/// The local plane that stands in for the surface near a pad.
struct PadPlane {
  Vec3 middle = Vec3::Zero();  ///< of the pad, for which it was found
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitY();  ///< unit, out of the solid
};

/// The sides of an inside corner besides the nearest: three meet in a point.
struct OtherSides {
  std::array<PadPlane, 2> planes;
  std::size_t count = 0;

  [[nodiscard]] std::span<const PadPlane> seen() const noexcept { return {planes.data(), count}; }
};

/// What is remembered of a pad.
struct PadMemory {
  SurfaceHint hint;
  std::optional<PadPlane> plane;
  OtherSides beside;              ///< of the inside corner that it is in
  Vec3 seen_from = Vec3::Zero();  ///< where it, or one whose ball it shares, looked from last
  Vec3 outward = Vec3::Zero();    ///< unit, off the surface, where it was too far; zero elsewhere
  double curvature = 0.0;         ///< there, along the way that the pad went, 1/m; convex above 0
  double same_m = 0.0;            ///< the plane serves within this of there
  double clearance_m = 0.0;       ///< there; more where its skin faces away
  double free_m = 0.0;            ///< what was left of that when last seen, plus `travel_m` then
  /// By how much the tracked hand's pad is out of the object at the least, plus `way_m`.
  double out_until_m = -std::numeric_limits<double>::infinity();
};

/// What is drawn to the surface: each part, and the skin that is nearest to it, whichever it is.
inline constexpr std::size_t kPulls = kPartCount + 1;

/// The hand's freedoms: shift and turn of the wrist, then four bends a digit.
inline constexpr Eigen::Index kHandFreedoms = 6 + 4 * 5;
using HandFreedoms = Eigen::Matrix<double, kHandFreedoms, 1>;
[[nodiscard]] constexpr Eigen::Index first_freedom(std::size_t digit) {
  return 6 + 4 * static_cast<Eigen::Index>(digit);
}

/// What a row wants of a point of the hand.
enum class RowKind : std::uint8_t {
  keep_out,   ///< of the object, and over a cushion where there is one
  draw_near,  ///< to the surface
  climb,      ///< no less than so far in a round
  hold_back,  ///< from going farther in a frame
};

/// One point of the hand against one plane: how its gap grows with the hand's freedoms.
struct ContactRow {
  RowKind kind = RowKind::keep_out;
  const FleshPoint* point = nullptr;  ///< lasts as long as the row
  Eigen::Matrix<double, 6, 1> wrist = Eigen::Matrix<double, 6, 1>::Zero();  ///< shift, turn
  DigitFreedoms bend = DigitFreedoms::Zero();
  std::optional<Digit> digit;  ///< whose bend counts
  double gap_m = 0.0;
  double cushion_m = 0.0;  ///< nearer than this, what keeps out begins softly
  double brake_m = 0.0;    ///< nearer than this, it brakes
  double curvature = 0.0;  ///< of the surface, 1/m; convex above 0
  double stiffness = 0.0;  ///< of what draws near, holds back or brakes

  /// Nearer than this, what keeps out pushes.
  [[nodiscard]] double push_reach_m() const { return std::max(cushion_m, brake_m); }
};

/// A frame as it was settled.
struct SettledFrame {
  std::optional<HandPose> tracked;
  HandPose drawn;
  Correction correction;
};

/// One for each joint.
using JointVectors = std::array<Vec3, kJointCount>;

/// How a tracked hand's joints accelerate by one clock, and how much of that is new in each sample.
/// The means are over about a third of a second of the root mean square over the joints, and of
/// square roots, so that one sudden turn counts for little.
struct Acceleration {
  JointVectors velocity{};        ///< in the last sample; m, and by that clock's time
  JointVectors latest{};          ///< acceleration, the same way
  double root_mean = 0.0;         ///< (m/s^2)^1/2
  double change_root_mean = 0.0;  ///< of its change since the sample before
};

/// How a tracked hand moves as seen from one place, by two clocks.
struct SeenMotion {
  JointVectors joints{};    ///< in the last sample, m
  Acceleration by_times;    ///< as the frames' times have it
  Acceleration by_samples;  ///< as if all were as far apart
};

/// Tremor, and the tracker's errors. What the object adds to a restless motion is less to be seen
/// than on a smooth one. Frames may come unevenly, or only their times may; the object may move
/// under the hand, or with it: where and by the clock by which the hand is calmest, it is seen
/// right.
struct Unrest {
  int samples = 0;         ///< of this motion, up to 4: enough for all of it
  double elapsed_s = 0.0;  ///< since the last
  double age_s = 0.0;      ///< since this hand was first seen
  double apart_s = 0.0;    ///< samples, in the mean
  double frame_s = 0.0;    ///< between frames, in the mean: those that repeat a pose are no samples
  SeenMotion from_home;
  SeenMotion from_object;
};

/// Each finger's middle and last flexion together, radians; 0 for the thumb.
using FingerCurls = std::array<double, kDigitCount>;

/// What was seen of a deforming surface near a joint of the drawn hand.
struct SurfaceWatch {
  SurfaceHint hint;
  std::optional<SurfacePoint> before;  ///< in the last frame's shape
};
inline constexpr std::size_t kSurfaceWatches = 7;

/// How the hand touches the surface.
struct ContactState {
  Vec3 push = Vec3::Zero();    ///< unit, the way the object pushes; zero in the air
  Vec3 normal = Vec3::Zero();  ///< of the surface under the tracked palm; zero in the air
  double height_m = 0.0;       ///< of the drawn hand over the tracked one along `push`
  double nearest_m = 0.0;      ///< from the drawn skin that is nearest to the surface to it
  double deepest_m = 0.0;      ///< of the tracked skin below the surface, the deepest
  double softness_m = 0.0;     ///< of the object, smoothed
  double softness_depth_m = 0.02;
  Vec3 carried = Vec3::Zero();    ///< along the surface, from what was stroked so far
  Vec3 lag = Vec3::Zero();        ///< along the surface, by friction
  Vec3 drawn_lag = Vec3::Zero();  ///< the same, smoothed
  bool slips = false;
  FingerCurls curl_at_touch{};         ///< of the tracked hand; in the air, now
  std::array<double, kPulls> pulls{};  ///< times the full pull on a calm hand
};

/// A frame after which the tracked hand jumped.
struct FrameBeforeJump {
  SettledFrame frame;
  ContactState contact;
  double ago_s = std::numeric_limits<double>::infinity();
};
/// Of the last few jumps: a tracker may err anew before it is back.
using FramesBeforeJumps = std::array<FrameBeforeJump, 3>;

/// What settle_hand remembers of a hand from frame to frame, and room to work in. All of it is in
/// the object's frame, and in the world's lengths; but of the hand's unrest half is as seen from
/// `home`. A copy would lack that room: it can only be moved.
struct SettleMemory {
  SettleMemory() = default;
  SettleMemory(const SettleMemory&) = delete;
  SettleMemory& operator=(const SettleMemory&) = delete;
  SettleMemory(SettleMemory&&) noexcept = default;
  SettleMemory& operator=(SettleMemory&&) noexcept = default;
  ~SettleMemory() = default;

  Pose home;                 ///< where the object was when the hand was found, in the world
  Pose place;                ///< and in the last frame
  Vec3 went = Vec3::Zero();  ///< the tracked palm's way in the last frame, in the world
  SettledFrame last;
  ContactState contact;       ///< in it
  Correction before;          ///< that of the frame before it
  Correction shown;           ///< that of it as drawn, which may be on its way there
  bool fresh = false;         ///< whether the hand was found anew in it
  ObjectIdentity object;      ///< the last frame's
  std::uint64_t shape = 0;    ///< the surface's, in the last frame
  double scale = 1.0;         ///< and the object's
  double undeformed_s = 0.0;  ///< how long both have been the same
  SurfaceHint under_palm;     ///< where the surface's normal was found
  SurfaceHint under_hand;     ///< and as seen from above the hand
  SurfaceHint under_nearest;  ///< and under the nearest drawn skin
  double clear_s = 0.0;  ///< how long the tracked hand is clear of the object, the drawn one far
  double stuck_s = 0.0;  ///< how long the drawn one is held up; the longer, the farther off it is
  HandFreedoms returning = HandFreedoms::Zero();  ///< from where a hand that was let go comes back
  double return_share = 0.0;                      ///< and how much of that is left, 1 to 0
  std::size_t last_inside = 0;  ///< the pad whose tracked skin was last found in the object
  Unrest unrest;
  HandFreedoms geometric = HandFreedoms::Zero();  ///< stiffness, of the last round's contacts
  FramesBeforeJumps before_jumps;
  std::array<SurfaceWatch, kSurfaceWatches> watches;  ///< while the object deforms
  std::vector<PadMemory> pads;
  std::vector<ContactRow> rows;
  JointVectors velocity{};  ///< of the tracked joints against the object, smoothed, m/s
  JointVectors pace{};      ///< velocity of the drawn joints, m/s
  JointVectors drift{};     ///< and what of it the tracked ones did not have
  JointVectors joints{};    ///< of the hand as looked at last
  double travel_m = 0.0;    ///< the sum of what its farthest joint went from look to look
  double way_m = 0.0;       ///< and of what the tracked hand's went from frame to frame
  double rest = 0.0;        ///< how still the tracked hand has kept of late, 1 at rest
  double strike_mps = 0.0;  ///< how fast it went to the surface, or from it
};

/// A memory with room for a hand's pads; settle_hand allocates nothing then.
[[nodiscard]] SettleMemory settle_memory(const HandFlesh& flesh);

/// The surface is another, or the hand elsewhere: what its pads saw does not count.
void forget_planes(SettleMemory& memory) noexcept;

/// The surface is another's: nothing is known of it.
void forget_surface(SettleMemory& memory) noexcept;

/// The hand is found anew: what is known of its last frame, and of the surface, does not count. It
/// may still jump back to where it was.
void forget_frame(SettleMemory& memory) noexcept;

/// The next frame's hand is another's: nothing is known of it.
void forget_hand(SettleMemory& memory) noexcept;

/// The hand settled on the surface.
struct SettledHand {
  HandPose hand;  ///< bit for bit the tracked one where nothing is to be corrected
  Contacts contacts{};
  bool touches = false;    ///< or is about to land, or hovers for a moment over what is pressed in
  bool corrected = false;  ///< or touched until just now: the hand is not the tracked one
};

/// The whole hand out of the object, with the least change of the tracked pose: palm, knuckles,
/// every phalanx and the thumb's ball. Goes on from the last frame's answer. `scale` is the
/// tracked hand's size over the flesh's; `seconds` the time since the last frame.
[[nodiscard]] SettledHand settle_hand(const HandPose& tracked, const HandFlesh& flesh, double scale,
                                      const Object& object, double seconds,
                                      const SettleOptions& options, SettleMemory& memory) noexcept;

}  // namespace nade
