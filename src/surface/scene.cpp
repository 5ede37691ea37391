#include "nade/scene.h"

#include <limits>

#include "nade/assert.h"
#include "nade/corrector.h"
#include "surface_query.h"

namespace nade {

Scene::Scene() : number_(new_shape()) {}

bool Scene::add(ObjectId id, const Surface& surface, const Placement& placement,
                const SettleOptions& feel) {
  NADE_ASSERT(check_options(feel).ok());
  if (index_.contains(id)) return false;
  const Member added{id, Object(surface, placement, new_shape()), feel, surface.bounds()};
  if (members_.size() == members_.capacity()) {
    // Before anything changes: where there is no memory nothing does.
    const std::size_t room = 2 * members_.size() + 8;
    balls_.reserve(room);
    members_.reserve(room);
  }
  index_.emplace(id, members_.size());
  members_.push_back(added);
  balls_.push_back(ball_of(added));
  ++changes_;
  return true;
}

bool Scene::place(ObjectId id, const Placement& placement) noexcept {
  Member* const placed = member(id);
  if (placed == nullptr) return false;
  const Object& before = placed->object;
  if (before.placement() == placement) return true;
  placed->object = Object(before.surface(), placement, before.identity().instance);
  balls_[static_cast<std::size_t>(placed - members_.data())] = ball_of(*placed);
  ++changes_;
  return true;
}

bool Scene::deformed(ObjectId id) noexcept {
  Member* const found = member(id);
  if (found == nullptr) return false;
  found->bounds = found->object.surface().bounds();
  balls_[static_cast<std::size_t>(found - members_.data())] = ball_of(*found);
  ++changes_;
  return true;
}

bool Scene::set_feel(ObjectId id, const SettleOptions& feel) noexcept {
  NADE_ASSERT(check_options(feel).ok());
  Member* const found = member(id);
  if (found == nullptr) return false;
  found->feel = feel;
  ++changes_;
  return true;
}

bool Scene::remove(ObjectId id) noexcept {
  const auto found = index_.find(id);
  if (found == index_.end()) return false;
  const std::size_t gone = found->second;
  index_.erase(found);
  if (gone + 1 < members_.size()) {
    members_[gone] = members_.back();
    balls_[gone] = balls_.back();
    index_.find(members_[gone].id)->second = gone;
  }
  members_.pop_back();
  balls_.pop_back();
  ++changes_;
  return true;
}

const Object* Scene::find(ObjectId id) const noexcept {
  const auto found = index_.find(id);
  return found == index_.end() ? nullptr : &members_[found->second].object;
}

Scene::Member* Scene::member(ObjectId id) noexcept {
  const auto found = index_.find(id);
  return found == index_.end() ? nullptr : &members_[found->second];
}

Scene::Ball Scene::ball_of(const Member& member) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  // nothing is within that
  const Placement& placement = member.object.placement();
  const Pose& pose = placement.pose;
  if (placement.scale == 0.0 || !pose.position.allFinite() || !pose.rotation.coeffs().allFinite()) {
    return {Vec3::Zero(), kNone};
  }
  if (!member.bounds) return {Vec3::Zero(), kInfinity};
  const auto& [low, high] = *member.bounds;
  return {placement.to_world(0.5 * (low + high)), 0.5 * placement.scale * (high - low).norm()};
}

}  // namespace nade
