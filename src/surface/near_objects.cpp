#include "near_objects.h"

#include <algorithm>
#include <cmath>

#include "member_hint.h"

namespace nade {
namespace {

/// A hand's own skin around its joints.
constexpr double kSkin_m = 0.03;
/// Numerics: what moves by less, metres and parts of a quaternion, is only rounded otherwise.
constexpr double kStill = 1e-6;
/// What goes farther in a frame, where the hand is, was put elsewhere.
constexpr double kSudden_m = 0.1;

bool is_still(const Pose& one, const Pose& other) {
  return (one.position - other.position).norm() < kStill &&
         (one.rotation.coeffs() - other.rotation.coeffs()).norm() < kStill;
}

static_assert(NearObjects::kMost <= kMostMembers);

/// How far what is there goes from one pose to the other.
double way_between(const Pose& before, const Pose& now, const Vec3& there) {
  return (now.apply(before.inverse().apply(there)) - there).norm();
}

}  // namespace

double ObjectDistance::at_least(const Vec3& point) const noexcept {
  if (!is_there) return std::numeric_limits<double>::infinity();
  const double from_there_m = from_m - (point - from).norm();
  if (!bounds) return from_there_m;
  return std::max(from_there_m, placement.scale * bounds->distance(placement.to_local(point)));
}

Vec3 velocity_at(const Vec3& point_world, const Placement& before, const Placement& now,
                 double seconds) noexcept {
  return (point_world - before.to_world(now.to_local(point_world))) / seconds;
}

std::size_t NearObjects::place_of(const SurfaceHint& hint) noexcept { return member_of(hint); }

void NearObjects::forget() noexcept {
  if (version_ == Version{}) return;
  free_places();
  carrier_ = touched_ = kNone;
  change_count_ = other_count_ = 0;
  carrier_before_.reset();
  version_ = {};
}

void NearObjects::free_places() noexcept {
  for (Place& place : places_) place.instance = 0;
}

void NearObjects::gather(const Scene& scene, const HandPose& tracked,
                         const HandPose* drawn) noexcept {
  if (scene.number_ != version_.scene) forget();
  version_ = {scene.number_, scene.changes_, 0};
  change_count_ = other_count_ = 0;
  carrier_before_.reset();
  measure_hand(tracked, drawn);
  look_around(scene);
  if (found_count_ == 0) find_far_carrier(scene);
  find_places(scene);
  const Found* const next = next_carrier();
  if (next == nullptr) {
    free_places();
    carrier_ = touched_ = kNone;
    return;
  }
  // What is known of the last frame is about the old carrier: no more where the new one was not.
  const bool was_near = next->place != kNone;
  if (was_near && next->place != carrier_) change_carrier(next->place);
  let_go();
  follow_carrier(scene, *next);
  for (const Found& found : found()) {
    if (&found != next) follow(scene, found);
  }
  if (!was_near) change_count_ = 0;
}

void NearObjects::measure_hand(const HandPose& tracked, const HandPose* drawn) noexcept {
  Vec3 low = tracked.joints[0].position;
  Vec3 high = low;
  const std::array hands{&tracked, drawn};
  for (const HandPose* const hand : hands) {
    if (hand == nullptr) continue;
    for (const Pose& joint : hand->joints) {
      low = low.cwiseMin(joint.position);
      high = high.cwiseMax(joint.position);
    }
  }
  middle_ = 0.5 * (low + high);
  double farthest = 0.0;
  for (const HandPose* const hand : hands) {
    if (hand == nullptr) continue;
    for (const Pose& joint : hand->joints) {
      farthest = std::max(farthest, (joint.position - middle_).squaredNorm());
    }
  }
  radius_m_ = std::sqrt(farthest) + kSkin_m;
  reach_m_ = radius_m_ + kWithinReach_m;
}

void NearObjects::look_around(const Scene& scene) noexcept {
  found_count_ = 0;
  for (std::size_t i = 0; i < scene.balls_.size(); ++i) {
    const Scene::Ball& ball = scene.balls_[i];
    const double within_m = reach_m_ + ball.radius_m;
    if (!((ball.middle - middle_).squaredNorm() <= within_m * within_m)) continue;
    const Scene::Member& member = scene.members_[i];
    const Placement& placement = member.object.placement();
    Found found{i};
    if (member.bounds) {
      found.bounds_m = placement.scale * member.bounds->distance(placement.to_local(middle_));
    }
    if (found.bounds_m <= reach_m_) add_found(found);
  }
}

void NearObjects::add_found(const Found& found) noexcept {
  if (found_count_ < kMost) {
    found_[found_count_++] = found;
    return;
  }
  Found& farthest = *std::max_element(
      found_.begin(), found_.end(),
      [](const Found& one, const Found& other) { return one.bounds_m < other.bounds_m; });
  if (found.bounds_m < farthest.bounds_m) farthest = found;
}

/// Where nothing is near, the carrier stays what it was, so that a hand that comes back goes on;
/// and an object that is alone is the carrier from the first frame on, as without a scene.
void NearObjects::find_far_carrier(const Scene& scene) noexcept {
  std::size_t far = scene.size();
  if (carrier_ != kNone) {
    const auto found = scene.index_.find(places_[carrier_].id);
    if (found != scene.index_.end()) far = found->second;
  } else if (scene.size() == 1) {
    far = 0;
  }
  if (far == scene.size() || std::isnan(scene.balls_[far].radius_m)) return;
  found_[found_count_++] = {far};
}

void NearObjects::find_places(const Scene& scene) noexcept {
  for (Found& each : found()) {
    const Object& object = scene.members_[each.member].object;
    const auto place = std::find_if(places_.begin(), places_.end(), [&](const Place& kept) {
      return kept.instance == object.identity().instance;
    });
    each.place = static_cast<std::size_t>(place - places_.begin());
    if (found_count_ == 1) continue;
    SurfaceHint none;
    const auto nearest = object.closest_point(middle_, reach_m_, none);
    each.from_m = nearest ? nearest->signed_distance : reach_m_;
  }
}

const NearObjects::Found* NearObjects::next_carrier() const noexcept {
  const Found* const end = found_.data() + found_count_;
  for (const std::size_t wanted : {touched_, carrier_}) {
    if (wanted == kNone) continue;
    const Found* const still_near = std::find_if(
        found_.data(), end, [wanted](const Found& found) { return found.place == wanted; });
    if (still_near != end) return still_near;
  }
  const Found* const nearest = std::min_element(
      found_.data(), end,
      [](const Found& one, const Found& other) { return one.from_m < other.from_m; });
  return nearest == end ? nullptr : nearest;
}

/// All that is remembered is seen from another from now on.
void NearObjects::change_carrier(std::size_t next) noexcept {
  const Place& to = places_[next];
  const Pose from_other = to.against_carrier.inverse();
  carrier_before_ = CarrierBefore{to.object.placement(), to.shape, from_other,
                                  places_[carrier_].object.placement().scale};
  for (Place& place : places_) {
    if (place.instance == 0) continue;
    place.against_carrier = from_other * place.against_carrier;
    place.against_carrier.rotation.normalize();
    place.from = from_other.apply(place.from);
  }
}

/// Those that are not near any more.
void NearObjects::let_go() noexcept {
  for (std::size_t i = 0; i < kMost; ++i) {
    Place& place = places_[i];
    const bool is_near = std::any_of(found_.data(), found_.data() + found_count_,
                                     [i](const Found& found) { return found.place == i; });
    if (place.instance == 0 || is_near) continue;
    NearChange& change = changes_[change_count_++];
    change = {i, distance_of(place), {}, true};
    change.now.is_there = false;
    place.instance = 0;
  }
}

/// The object's place, a free one if it had none.
NearObjects::Place& NearObjects::place_for(const Scene::Member& member,
                                           const Found& found) noexcept {
  const bool is_new = found.place == kNone;
  Place& place = is_new ? *std::find_if(places_.begin(), places_.end(),
                                        [](const Place& each) { return each.instance == 0; })
                        : places_[found.place];
  place.before = is_new ? std::nullopt : std::optional(place.object.placement());
  place.instance = member.object.identity().instance;
  place.id = member.id;
  place.object = member.object;
  return place;
}

void NearObjects::follow_carrier(const Scene& scene, const Found& found) noexcept {
  const Scene::Member& member = scene.members_[found.member];
  Place& place = place_for(member, found);
  (void)follow_shape(place, found.place == kNone);
  place.against_carrier = {};
  place.from_m = -std::numeric_limits<double>::infinity();
  carrier_ = static_cast<std::size_t>(&place - places_.data());
  feel_ = member.feel;
}

/// Whether it has another shape than in the last frame.
bool NearObjects::follow_shape(Place& place, bool is_new) noexcept {
  const Surface& surface = place.object.surface();
  const std::uint64_t shape = surface.shape();
  if (!is_new && shape == place.shape) return false;
  place.shape = shape;
  place.bounds = surface.bounds();
  return true;
}

void NearObjects::follow(const Scene& scene, const Found& found) noexcept {
  const bool is_new = found.place == kNone;
  NearChange change;
  change.before.is_there = false;
  if (!is_new) change.before = distance_of(places_[found.place]);
  Place& place = place_for(scene.members_[found.member], found);
  const Placement& placement = place.object.placement();
  const Placement& carrier = places_[carrier_].object.placement();
  const Pose from_world = carrier.pose.inverse();
  const Pose pose = from_world * placement.pose;
  place.from = from_world.apply(middle_);
  place.from_m = found.from_m;
  const bool deformed = follow_shape(place, is_new) || place.before->scale != placement.scale;
  const bool moved = is_new || !is_still(place.against_carrier, pose);
  change.sudden = is_new || way_between(place.against_carrier, pose, place.from) > kSudden_m;
  if (moved) place.against_carrier = pose;
  const Pose& against = place.against_carrier;
  place.local = Object(
      place.object.surface(),
      {{against.position / carrier.scale, against.rotation}, placement.scale / carrier.scale});
  change.place = static_cast<std::size_t>(&place - places_.data());
  others_[other_count_++] = change.place;
  if (!moved && !deformed) return;
  change.now = distance_of(place);
  changes_[change_count_++] = change;
}

ObjectDistance NearObjects::distance_of(const Place& place) noexcept {
  return {true,
          place.from,
          place.from_m,
          place.bounds,
          {place.against_carrier, place.object.placement().scale}};
}

Object NearObjects::object() const noexcept {
  if (carrier_ == kNone) return nothing();
  const Place& carrier = places_[carrier_];
  return Object(*this, carrier.object.placement(), carrier.instance);
}

Rearrangement NearObjects::rearrangement() const noexcept {
  return {{changes_.data(), change_count_}, carrier_before_, radius_m_};
}

void NearObjects::touch(std::span<const std::size_t> places) noexcept {
  const bool holds = std::find(places.begin(), places.end(), carrier_) != places.end();
  touched_ = places.empty() ? kNone : holds ? carrier_ : places.front();
}

Vec3 NearObjects::velocity_of(std::size_t place, const Vec3& point_world,
                              double seconds) const noexcept {
  const Place& its = places_[place];
  if (!its.before) return Vec3::Zero();
  return velocity_at(point_world, *its.before, its.object.placement(), seconds);
}

std::size_t NearObjects::nearest_to(const Vec3& point_world) const noexcept {
  SurfaceHint hint;
  if (other_count_ == 0) return carrier_;
  const bool found = object().closest_point(point_world, kWithinReach_m, hint).has_value();
  return found ? place_of(hint) : carrier_;
}

NearObjects::Version NearObjects::version_of(const Scene& scene) const noexcept {
  Version version{scene.number_, scene.changes_, 0};
  if (version.scene != version_.scene || version.changes != version_.changes) return version;
  if (carrier_ != kNone) version.shapes = shape();
  for (std::size_t i = 0; i < other_count_; ++i) {
    version.shapes = with_shape(version.shapes, places_[others_[i]].object.surface().shape());
  }
  return version;
}

std::optional<RayHit> NearObjects::first_hit(const Ray& ray) const noexcept {
  std::optional<RayHit> first = places_[carrier_].object.surface().first_hit(ray);
  for (std::size_t i = 0; i < other_count_; ++i) {
    const double reach = first ? first->distance : ray.max_distance;
    const auto hit = places_[others_[i]].local.first_hit({ray.origin, ray.direction, reach});
    if (hit && (!first || hit->distance < first->distance)) first = hit;
  }
  return first;
}

std::optional<SurfacePoint> NearObjects::closest_point(const Vec3& query, double max_distance,
                                                       SurfaceHint& hint) const noexcept {
  const SurfaceHint before = hint;
  SurfaceHint its = hint_in(carrier_, before);
  std::optional<SurfacePoint> deepest =
      places_[carrier_].object.surface().closest_point(query, max_distance, its);
  hint = hint_for_all(carrier_, its);
  for (std::size_t i = 0; i < other_count_; ++i) {
    const Place& place = places_[others_[i]];
    const Placement& placement = place.local.placement();
    if (place.bounds &&
        placement.scale * place.bounds->distance(placement.to_local(query)) > max_distance) {
      continue;
    }
    its = hint_in(others_[i], before);
    const auto found = place.local.closest_point(query, max_distance, its);
    if (!found || (deepest && found->signed_distance >= deepest->signed_distance)) continue;
    deepest = found;
    hint = hint_for_all(others_[i], its);
  }
  return deepest;
}

std::uint64_t NearObjects::shape() const noexcept {
  return places_[carrier_].object.surface().shape();
}

}  // namespace nade
