#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "nade/settle_options.h"
#include "nade/surface.h"

namespace nade {

class NearObjects;

/// An object of a scene: any number, as an engine's own of what it has there.
using ObjectId = std::uint64_t;

/// All objects that a hand may touch, as an engine has them: hundreds, many of them moving. Any
/// number of correctors may share it. In each frame, and for each hand, those within reach are
/// found by their surfaces' bounds; others cost nothing but that, and change nothing. A hand may
/// touch several at a time, slide from one to another, and ride along on the one it touches while
/// the others move as they like. Where solids overlap they are one.
///
/// Within reach of a hand is what is nearer than 0.3 m to it by its bounds, and what has none; of
/// more than 64, the nearest. World coordinates.
///
/// Threads: not to be changed while a corrector looks at it.
class Scene {
 public:
  Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  Scene(Scene&&) = default;
  Scene& operator=(Scene&&) = default;
  ~Scene() = default;

  /// One more object. `surface` must outlive it there. `feel` as `check_options` takes it. An
  /// object that comes where a hand is pushes it out slowly. May allocate. Gives false, and does
  /// nothing, where the id is another object's already.
  bool add(ObjectId id, const Surface& surface, const Placement& placement = {},
           const SettleOptions& feel = {});
  bool add(ObjectId, const Surface&&, const Placement& = {}, const SettleOptions& = {}) = delete;

  /// Moves, turns or scales an object; a scale of 0 hides it. Does not allocate. Gives false where
  /// there is no such id.
  bool place(ObjectId id, const Placement& placement) noexcept;

  /// The object's surface has another shape, and `Surface::bounds` are asked anew. To be called
  /// whenever these changed. Does not allocate. Gives false where there is no such id.
  bool deformed(ObjectId id) noexcept;

  /// How it feels from the next frame on; `feel` as `check_options` takes it. Of several objects
  /// that a hand touches, the one that it touched first counts. Does not allocate. Gives false
  /// where there is no such id.
  bool set_feel(ObjectId id, const SettleOptions& feel) noexcept;

  /// A hand on it comes back slowly to where the person is. May allocate. Gives false where there
  /// is no such id.
  bool remove(ObjectId id) noexcept;

  /// The object where it stands; none where there is no such id. Valid until one is added or
  /// removed.
  [[nodiscard]] const Object* find(ObjectId id) const noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return members_.size(); }

 private:
  friend class NearObjects;

  struct Member {
    ObjectId id;
    Object object;  ///< its instance is a number that no other member ever had
    SettleOptions feel;
    std::optional<SurfaceBounds> bounds;
  };

  /// A ball in the world that a member is in.
  struct Ball {
    Vec3 middle = Vec3::Zero();
    double radius_m = 0.0;
  };

  [[nodiscard]] Member* member(ObjectId id) noexcept;
  [[nodiscard]] static Ball ball_of(const Member& member) noexcept;

  std::vector<Member> members_;
  std::vector<Ball> balls_;  ///< theirs: all that is looked at of those out of reach
  std::unordered_map<ObjectId, std::size_t> index_;
  std::uint64_t number_;       ///< no other scene's
  std::uint64_t changes_ = 0;  ///< how often something of it has
};

}  // namespace nade
