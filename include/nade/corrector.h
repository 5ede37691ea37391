#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <variant>

#include "nade/contact.h"
#include "nade/correction.h"
#include "nade/fingers.h"
#include "nade/flesh.h"
#include "nade/scene.h"
#include "nade/settle_options.h"
#include "nade/status.h"

namespace nade {

class ProxyHand;
struct ProxyTuning;

enum class Method : std::uint8_t {
  none,   ///< the tracked hand, bit for bit
  paper,  ///< contact rays, seated palm, laid fingers (2023)
  nade,   ///< a proxy hand with soft flesh lies on the surface
};

/// "none", "paper" or "nade", as on the command line and in files.
[[nodiscard]] std::string_view name_of(Method method);
[[nodiscard]] std::optional<Method> method_from_name(std::string_view name);

/// Where the length of a fingertip's c_j comes from. The palm's is always the mesh's.
enum class SkinSource : std::uint8_t {
  radii,  ///< the tracker's fingertip radii where they are believable, else the mesh
  mesh,   ///< the hand mesh, scaled to the person's hand
};

struct CorrectorOptions {
  Method method = Method::nade;
  /// From here to `release_s`: method `paper` only.
  ContactOptions contact;
  FingerOptions fingers;
  SkinSource skin_source = SkinSource::radii;
  /// c_j at the generic hand's size; measure it on your own hand mesh if you draw another.
  SkinDepths skin = generic_skin_depths();
  /// Wrist to middle knuckle of the mesh `skin` was measured on, metres, > 0.
  double skin_hand_length_m = kGenericHandLength;
  /// What is left of a correction where it cannot be continuous (an edge, a teleport, tracking
  /// lost and found) fades over this time. Seconds, 0 (at once) to 1.
  double release_s = 0.2;
  SettleOptions settle;
  /// Wrist to middle knuckle of the hand that is drawn, metres, where it is known, as from a
  /// calibration, below 0.5; 0: what the tracker says on the average so far. A tracker may err by a
  /// tenth.
  double hand_length_m = 0.0;
  /// Method `nade`: what can touch of each hand, by index_of(Handedness). Measure it on your own
  /// hand mesh if you draw another than the generic hand, which empty ones stand for.
  std::array<std::shared_ptr<const HandFlesh>, 2> flesh;
  /// Method `nade`, for those who develop it (src/proxy/tuning.h): none for the numbers that it
  /// has.
  std::shared_ptr<const ProxyTuning> tuning;
};

/// Whether options are what each of them may be; the error names the first that is not. A corrector
/// takes no others.
[[nodiscard]] Status check_options(const CorrectorOptions& options);
[[nodiscard]] Status check_options(const SettleOptions& options);

/// All open points as the paper's bare text has them, for comparison.
[[nodiscard]] CorrectorOptions paper_literal();

/// Fingertip radii a tracker really measured, palm left 0: positive, between 3 and 15 mm, not
/// one value for every joint.
[[nodiscard]] std::optional<SkinDepths> believable_radii(const HandPose& hand) noexcept;

/// Skin of one bone that touches an object; in the tracked hand's frame.
struct SkinContact {
  ObjectId object = 0;  ///< of the scene; of an object that was given alone, its `instance`
  /// A phalanx by the joint at its base, as `index_intermediate`; `thumb_metacarpal`; or `palm`,
  /// for all the rest.
  Joint bone = Joint::palm;
  Vec3 point = Vec3::Zero();         ///< on the surface
  Vec3 normal = Vec3::UnitY();       ///< unit, out of the solid
  double depth_m = 0.0;              ///< of the person's skin in the object, >= 0: how it presses
  Vec3 velocity_mps = Vec3::Zero();  ///< of the drawn skin there against the object
};

/// The phalanges, the thumb's metacarpal and the palm.
inline constexpr std::size_t kMostSkinContacts = 16;

/// A velocity of 0 for each joint.
[[nodiscard]] std::array<Vec3, kJointCount> no_velocity() noexcept;

/// What to draw, and why; in the tracked hand's frame.
struct CorrectedHand {
  HandPose pose;  ///< to draw: bit for bit the tracked one where there is nothing to correct
  HandStatus status = HandStatus::untracked;
  std::optional<HandFault> fault{};  ///< why a hand that was passed is `untracked`
  Contacts contacts{};  ///< of each part that the person presses in; none of the others
  std::array<double, kDigitCount> ray_turn_rad{};  ///< of method paper: the fingers' turned rays
  /// Of each bone that touches at most one, and none while what was let go comes back; by method
  /// paper of the palm and the fingertips.
  std::array<SkinContact, kMostSkinContacts> skin_contacts{};
  std::size_t skin_contact_count = 0;
  /// Of the drawn joints, in the axes of the tracked hand's frame; 0 in a hand's first frame.
  std::array<Vec3, kJointCount> velocity_mps = no_velocity();
};

/// Corrects one hand, frame by frame. Keep one for each hand; it is the only thing with memory. One
/// that was moved from can only be assigned to.
///
/// Threads: a corrector is used by one at a time. Any number of correctors may run at once, also on
/// objects, surfaces and meshes that they share, while none of these is placed anew or refitted.
/// Only the assert handler is global.
class HandCorrector {
 public:
  /// `options` as `check_options` takes them.
  explicit HandCorrector(const CorrectorOptions& options = {});
  HandCorrector(HandCorrector&&) noexcept;
  HandCorrector& operator=(HandCorrector&&) noexcept;
  ~HandCorrector();

  /// The hand to draw for a tracked hand at `time_ns` (any origin), valid until the next call and
  /// not to be given back as `tracked`. Never allocates or throws; the pose is finite if the
  /// tracked one is. Method `paper` leaves a hand as it is that it would draw more than 10 m off.
  /// Where an object's triangles go through each other by the thousand, so that a frame's queries
  /// would look at more than 1,000,000 nodes and leaves of the meshes, the tracked hand comes back,
  /// status `free`; no mesh that is like a surface takes so many. Rotations from half to twice the
  /// unit length are made unit first (`with_unit_rotations`). A pose that cannot be used even so
  /// comes back as it is, status `untracked`, and `fault` says why. Where no object is near, give
  /// `nothing()`: a hand that is not passed is missing, and jumps when an object comes. Frames in
  /// which it is missing are simply not passed: one that presses on when it is back, within a
  /// second, goes on from where it was drawn. Time that goes back, or the other hand, starts anew;
  /// but back by 25 ms at the most, as where a clock is read late or a frame's display time
  /// foretold anew, counts as the same time. Asked again for the same time, hand and object, it
  /// gives the same answer and changes nothing; another hand at the same time counts as a frame of
  /// a millisecond later. Times may be whole milliseconds, and off by a few.
  const CorrectedHand& update(const HandPose& tracked, const Object& object,
                              std::int64_t time_ns) noexcept;

  /// The same for a hand that may touch any object of a scene, each of which has its own feel. One
  /// object alone in a scene gives the same hand, bit for bit, as it does by itself. Objects out of
  /// reach change nothing, bit for bit, where one was within reach when the hand was found. What
  /// moves beside the hand takes nothing from what is known of the object that it touches; that one
  /// takes it along. An object that is added, removed or put elsewhere under the hand lets it come
  /// back slowly.
  const CorrectedHand& update(const HandPose& tracked, const Scene& scene,
                              std::int64_t time_ns) noexcept;

  /// The latest correction on a newer pose of the same hand, as for a picture's late update: each
  /// joint is shifted and turned against the one before it as in the last frame. Remembers nothing;
  /// the last frame's own pose gives the hand that was drawn. `tracked` as it is where nothing was
  /// corrected, or where it cannot be used.
  [[nodiscard]] HandPose preview(const HandPose& tracked) const noexcept;

  /// Friction and softness from the next frame on, as where a hand goes over to another object. One
  /// that rests goes on from where it is drawn.
  void set_settle(const SettleOptions& settle) noexcept;

  /// Forgets everything about the hand so far.
  void reset() noexcept;

  [[nodiscard]] const CorrectorOptions& options() const { return options_; }

 private:
  struct Frame {
    HandPose tracked;
    Correction correction;  ///< of the paper's method, before any release
    std::int64_t time_ns = 0;
  };

  struct Question {
    HandPose tracked;
    ObjectIdentity object;  ///< of a scene: its number and no surface
    Placement placement;
    std::uint64_t shape = 0;    ///< of a scene: those of what is near
    std::uint64_t changes = 0;  ///< of a scene: how often it was changed
    std::int64_t time_ns = 0;
    bool operator==(const Question&) const = default;
  };

  /// What was drawn in a frame, and at which object.
  struct Shown {
    HandPose drawn;
    ObjectIdentity object;
    Placement placement;
    std::int64_t time_ns = 0;
  };

  /// What may be touched.
  using Touchable = std::variant<const Object*, const Scene*>;

  void answer(const HandPose& tracked, Touchable objects, std::int64_t time_ns) noexcept;
  void correct(const HandPose& tracked, Touchable objects, std::int64_t time_ns) noexcept;
  void add_contact(const SkinContact& contact, std::size_t place) noexcept;
  void add_part_contacts() noexcept;
  void measure_motion(const Object& object, std::int64_t time_ns) noexcept;
  void start_frame(const HandPose& tracked, std::int64_t time_ns) noexcept;
  void follow_length(double length_m) noexcept;
  void correct_by_paper(const HandPose& tracked, const Object& object,
                        std::int64_t time_ns) noexcept;
  void follow_proxy(const HandPose& tracked, const Object& object, std::int64_t time_ns) noexcept;
  void forget_proxies() noexcept;
  [[nodiscard]] const HandFlesh& flesh_of(Handedness side) const;
  [[nodiscard]] SkinDepths skin_of(const HandPose& tracked) const noexcept;
  void release(const HandPose& tracked, const Correction& correction,
               std::int64_t time_ns) noexcept;

  CorrectorOptions options_;
  ContactMemory contact_memory_;
  ObjectIdentity met_;                                 ///< that it is of
  std::array<std::unique_ptr<ProxyHand>, 2> proxies_;  ///< method nade; by index_of(Handedness)
  CorrectedHand result_;
  std::unique_ptr<NearObjects> near_;
  std::array<std::size_t, kMostSkinContacts> touched_{};  ///< whose contacts those of `result_` are
  std::optional<Shown> shown_;
  std::optional<Question> answered_;  ///< that `result_` is the answer to
  std::optional<Frame> last_;
  double hand_length_m_ = 0.0;      ///< mean over the last few seconds: bones do not grow
  std::int64_t frames_ = 0;         ///< that it is of
  std::int64_t frames_longer_ = 0;  ///< how many of the last were longer than it, all; < 0: shorter
  Correction residue_;              ///< what is being released
  std::optional<std::int64_t> release_start_ns_;
};

}  // namespace nade
