#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "nade/hand.h"
#include "nade/scene.h"

namespace nade {

// A hand is settled in the frame of one object of a scene, the carrier: the one that it touches, or
// is near. The others are where they are against that one; it is their motion against it that
// counts.

/// No surface is looked for farther from a hand.
inline constexpr double kWithinReach_m = 0.3;

/// The velocity, at a point of the world, of what was placed one way so many seconds ago and is
/// another way now.
[[nodiscard]] Vec3 velocity_at(const Vec3& point_world, const Placement& before,
                               const Placement& now, double seconds) noexcept;

/// What is known of how far an object is from anywhere. In the carrier's frame, metres.
struct ObjectDistance {
  bool is_there = true;
  /// The signed distance of one point.
  Vec3 from = Vec3::Zero();
  double from_m = -std::numeric_limits<double>::infinity();
  /// What it is within.
  std::optional<SurfaceBounds> bounds;
  Placement placement;

  /// No point of its surface is nearer than this; below 0: nothing is known, or it is inside.
  [[nodiscard]] double at_least(const Vec3& point) const noexcept;
};

/// An object beside the carrier that moved against it, deformed, came or went.
struct NearChange {
  std::size_t place = 0;  ///< its number among those that are near
  ObjectDistance before;
  ObjectDistance now;
  bool sudden = false;  ///< it came, went or jumped
};

/// The carrier as it was in the last frame, in which another was the carrier.
struct CarrierBefore {
  Placement placement;
  std::uint64_t shape = 0;
  Pose from_other;           ///< leads from that one's frame to its own, as both stood
  double other_scale = 1.0;  ///< that one's
};

/// What became of the objects about a hand since the last frame.
struct Rearrangement {
  std::span<const NearChange> changes;
  std::optional<CarrierBefore> carrier;  ///< none if it is the same, or was not near
  double hand_radius_m = 0.0;            ///< all of the hand is so near to where `now.from` is
};

/// Those objects of a scene that a hand may touch in a frame, as one surface in the carrier's
/// frame. Remembers from frame to frame where they were. Where solids overlap they are one, as in a
/// `SurfaceGroup`.
class NearObjects final : public Surface {
 public:
  static constexpr std::size_t kMost = 64;

  /// The number, among those that are near, of the one that was the nearest in a query.
  [[nodiscard]] static std::size_t place_of(const SurfaceHint& hint) noexcept;

  /// Begins a frame: finds what is near a tracked hand, and near as it was `drawn` last, if it was.
  void gather(const Scene& scene, const HandPose& tracked, const HandPose* drawn) noexcept;
  /// The next hand is another: nothing of the last frame counts.
  void forget() noexcept;
  /// Whether the last hand was one at a scene.
  [[nodiscard]] bool has_scene() const noexcept { return version_.scene != 0; }

  /// All that is near, placed as the carrier; `nothing()` without any.
  [[nodiscard]] Object object() const noexcept;
  /// The carrier's.
  [[nodiscard]] const SettleOptions& feel() const noexcept { return feel_; }
  [[nodiscard]] Rearrangement rearrangement() const noexcept;

  /// The hand touches those, the one that it presses most first. The carrier of the next frame is
  /// found by that.
  void touch(std::span<const std::size_t> places) noexcept;

  /// Of one that is near.
  [[nodiscard]] ObjectId id_of(std::size_t place) const noexcept { return places_[place].id; }
  /// The velocity of its material at a point, world, if it was near `seconds` ago.
  [[nodiscard]] Vec3 velocity_of(std::size_t place, const Vec3& point_world,
                                 double seconds) const noexcept;
  /// The one that a point of the world is nearest to.
  [[nodiscard]] std::size_t nearest_to(const Vec3& point_world) const noexcept;

  /// What tells a scene as it is from itself after any change, and from others: its own number, how
  /// often it changed, and the shapes of what is near.
  struct Version {
    std::uint64_t scene = 0;
    std::uint64_t changes = 0;
    std::uint64_t shapes = 0;
    bool operator==(const Version&) const = default;
  };
  /// `shapes` is 0 if it is not the scene of the last frame, unchanged.
  [[nodiscard]] Version version_of(const Scene& scene) const noexcept;

  [[nodiscard]] std::optional<RayHit> first_hit(const Ray& ray) const noexcept override;
  [[nodiscard]] std::optional<SurfacePoint> closest_point(
      const Vec3& query, double max_distance, SurfaceHint& hint) const noexcept override;
  /// The carrier's.
  [[nodiscard]] std::uint64_t shape() const noexcept override;

 private:
  static constexpr std::size_t kNone = kMost;

  /// An object that is near, or was in the last frame.
  struct Place {
    std::uint64_t instance = 0;  ///< of its object; 0: the place is free
    ObjectId id = 0;
    Object object = nothing();  ///< in the world
    std::optional<SurfaceBounds> bounds;
    std::uint64_t shape = 0;
    std::optional<Placement> before;  ///< in the world, if it was near in the last frame
    Pose against_carrier;             ///< world's lengths
    Object local = nothing();         ///< in the carrier's own frame
    Vec3 from = Vec3::Zero();         ///< the middle of the hand, in the carrier's frame
    double from_m = -std::numeric_limits<double>::infinity();  ///< its signed distance
  };

  /// A member of the scene that is within reach.
  struct Found {
    std::size_t member = 0;
    double bounds_m = 0.0;      ///< from the middle of the hand to its bounds
    double from_m = 0.0;        ///< its signed distance, where several are found
    std::size_t place = kNone;  ///< that it has
  };

  [[nodiscard]] std::span<Found> found() noexcept { return {found_.data(), found_count_}; }
  void measure_hand(const HandPose& tracked, const HandPose* drawn) noexcept;
  void look_around(const Scene& scene) noexcept;
  void add_found(const Found& found) noexcept;
  void find_far_carrier(const Scene& scene) noexcept;
  void find_places(const Scene& scene) noexcept;
  [[nodiscard]] const Found* next_carrier() const noexcept;
  void change_carrier(std::size_t next) noexcept;
  void free_places() noexcept;
  void let_go() noexcept;
  [[nodiscard]] Place& place_for(const Scene::Member& member, const Found& found) noexcept;
  [[nodiscard]] static bool follow_shape(Place& place, bool is_new) noexcept;
  void follow_carrier(const Scene& scene, const Found& found) noexcept;
  void follow(const Scene& scene, const Found& found) noexcept;
  [[nodiscard]] static ObjectDistance distance_of(const Place& place) noexcept;

  std::array<Place, kMost> places_;
  std::size_t carrier_ = kNone;
  std::size_t touched_ = kNone;  ///< the carrier where it is touched, else what is pressed most
  Version version_;              ///< of the scene in the last frame, without shapes
  SettleOptions feel_;

  // Of this frame.
  Vec3 middle_ = Vec3::Zero();  ///< of the hand, world
  double radius_m_ = 0.0;
  double reach_m_ = 0.0;  ///< from there: what is farther off is not near
  std::array<Found, kMost> found_;
  std::size_t found_count_ = 0;
  std::array<std::size_t, kMost> others_{};  ///< places of those beside the carrier
  std::size_t other_count_ = 0;
  std::array<NearChange, 2 * kMost> changes_;
  std::size_t change_count_ = 0;
  std::optional<CarrierBefore> carrier_before_;
};

}  // namespace nade
