#include "skin_probe.h"

#include <algorithm>
#include <cmath>

#include "nade/assert.h"

namespace nade {
namespace {

constexpr std::size_t kClusterCount = 64;

/// Bit i of a vertex: it is of part i's patch.
std::vector<std::uint8_t> find_patches(const HandMesh& mesh) {
  const SkinDepths depths = measure_skin_depths(mesh);
  std::vector<std::uint8_t> patches(mesh.vertices.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    for (std::size_t part = 0; part < kPartCount; ++part) {
      if (!is_in_patch(mesh, depths, part_at(part), i)) continue;
      patches[i] |= static_cast<std::uint8_t>(1U << part);
    }
  }
  return patches;
}

std::uint8_t heaviest_bone(const HandMesh& mesh, std::size_t vertex) {
  const std::array<float, 4>& weights = mesh.weights[vertex];
  const auto heaviest = std::max_element(weights.begin(), weights.end()) - weights.begin();
  return mesh.bones[vertex][static_cast<std::size_t>(heaviest)];
}

/// Vertices as far from each other as can be: each next is the farthest from those before.
std::vector<std::size_t> spread_middles(const HandMesh& mesh, std::vector<std::size_t>& owner) {
  const std::size_t count = mesh.vertices.size();
  std::vector<float> distance(count, std::numeric_limits<float>::infinity());
  owner.assign(count, 0);
  std::vector<std::size_t> middles;
  std::size_t next = 0;
  while (middles.size() < std::min(kClusterCount, count)) {
    for (std::size_t i = 0; i < count; ++i) {
      const float to_next = (mesh.vertices[i] - mesh.vertices[next]).squaredNorm();
      if (to_next >= distance[i]) continue;
      distance[i] = to_next;
      owner[i] = middles.size();
    }
    middles.push_back(next);
    next = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) -
                                    distance.begin());
  }
  return middles;
}

/// The hand's joints reach this far from the palm, and the skin no more than `kThickest_m` more.
constexpr double kThickest_m = 0.06;
double reach_of(const HandPose& hand, double scale) {
  double reach = 0.0;
  for (const Pose& joint : hand.joints) {
    reach = std::max(reach, (joint.position - hand[Joint::palm].position).norm());
  }
  return reach + scale * kThickest_m;
}

}  // namespace

SkinProbe::SkinProbe(const HandMesh& mesh, double scale)
    : mesh_(&mesh), scale_(scale), walls_(mesh.vertices.size()) {
  NADE_ASSERT(scale > 0.0 && std::isfinite(scale));
  NADE_ASSERT(mesh.normals.size() == mesh.vertices.size());
  make_clusters(find_patches(mesh));
  hints_.resize(vertices_.size());
  slot_of_.resize(vertices_.size());
  for (std::size_t slot = 0; slot < vertices_.size(); ++slot) {
    slot_of_[vertices_[slot].index] = slot;
  }
  distances_m_.resize(vertices_.size());
  through_m_.assign(vertices_.size(), kNotMeasured);
  skin_.resize(mesh.vertices.size());
  middles_.reserve(clusters_.size());
}

void SkinProbe::make_clusters(const std::vector<std::uint8_t>& patches) {
  std::vector<std::size_t> owner;
  const std::vector<std::size_t> middles = spread_middles(*mesh_, owner);
  for (std::size_t c = 0; c < middles.size(); ++c) {
    Cluster cluster{vertices_.size(), 1};
    vertices_.push_back({static_cast<std::uint32_t>(middles[c]), patches[middles[c]],
                         heaviest_bone(*mesh_, middles[c])});
    for (std::size_t i = 0; i < owner.size(); ++i) {
      if (owner[i] != c || i == middles[c]) continue;
      vertices_.push_back({static_cast<std::uint32_t>(i), patches[i], heaviest_bone(*mesh_, i)});
      ++cluster.count;
    }
    clusters_.push_back(cluster);
  }
}

Vec3 SkinProbe::position(std::size_t slot) const {
  return skin_[vertices_[slot].index].cast<double>();
}

double SkinProbe::measure(std::size_t slot, const Object& object, SkinReading& reading) {
  const auto nearest = object.closest_point(position(slot), kNotMeasured, hints_[slot]);
  if (!nearest) return kNotMeasured;
  const double distance = nearest->signed_distance;
  take(slot, distance, reading);
  if (std::abs(distance) <= kTouch_m) reading.touches = true;
  return distance;
}

void SkinProbe::take(std::size_t slot, double distance, SkinReading& reading) const {
  reading.lowest = std::min(reading.lowest, distance);
  for (std::size_t part = 0; part < kPartCount; ++part) {
    if ((vertices_[slot].patches >> part & 1U) == 0) continue;
    reading.patch_lowest[part] = std::min(reading.patch_lowest[part], distance);
  }
}

void SkinProbe::read_cluster(const MiddleReading& middle, const Object& object,
                             SkinReading& reading) {
  const Cluster& cluster = *middle.cluster;
  const Vec3 center = position(cluster.first);
  for (std::size_t slot = cluster.first + 1; slot < cluster.first + cluster.count; ++slot) {
    const double away = (position(slot) - center).norm();
    const double least = middle.distance_m - away;
    bool matters = least < reading.lowest;
    matters |= !reading.touches && least <= kTouch_m && middle.distance_m + away >= -kTouch_m;
    for (std::size_t part = 0; part < kPartCount && !matters; ++part) {
      matters = (vertices_[slot].patches >> part & 1U) != 0 && least < reading.patch_lowest[part];
    }
    if (matters) static_cast<void>(measure(slot, object, reading));
  }
}

void SkinProbe::complete(std::size_t vertex, const Object& object) {
  if (std::isfinite(distances_m_[vertex])) return;
  SurfaceHint& hint = hints_[slot_of_[vertex]];
  const auto nearest = object.closest_point(skin_[vertex].cast<double>(), kNotMeasured, hint);
  if (nearest) distances_m_[vertex] = std::min(nearest->signed_distance, through_m_[vertex]);
}

std::span<const double> SkinProbe::read_below(const HandPose& hand, const Object& object,
                                              double limit_m) {
  pose_skin(*mesh_, hand, scale_, skin_, {});
  std::fill(distances_m_.begin(), distances_m_.end(), kNotMeasured);
  if (least_distance(hand, object) >= limit_m) return distances_m_;
  for (const Cluster& cluster : clusters_) {
    const std::size_t middle = vertices_[cluster.first].index;
    complete(middle, object);
    const Vec3 center = position(cluster.first);
    for (std::size_t slot = cluster.first + 1; slot < cluster.first + cluster.count; ++slot) {
      const double least = distances_m_[middle] - (position(slot) - center).norm();
      const std::size_t vertex = vertices_[slot].index;
      if (std::min(least, through_m_[vertex]) < limit_m) complete(vertex, object);
    }
  }
  return distances_m_;
}

double SkinProbe::least_distance(const HandPose& hand, const Object& object) {
  const Vec3& palm = hand[Joint::palm].position;
  const auto under_palm = object.closest_point(palm, kNotMeasured, palm_hint_);
  return under_palm ? under_palm->signed_distance - reach_of(hand, scale_) : kNotMeasured;
}

void SkinProbe::follow_walls(const MiddleReading& middle, const HandPose& hand,
                             const Object& object, SkinReading& reading) {
  const Cluster& cluster = *middle.cluster;
  const Vec3 center = position(cluster.first);
  for (std::size_t slot = cluster.first; slot < cluster.first + cluster.count; ++slot) {
    const Vec3 now = position(slot);
    const double clear_m = std::abs(middle.distance_m) - (now - center).norm();
    const Vec3& bone = hand.joints[vertices_[slot].bone].position;
    const auto depth_m = walls_.follow(slot, {now, bone, clear_m}, object);
    if (!depth_m) continue;
    through_m_[vertices_[slot].index] = -*depth_m;
    take(slot, -*depth_m, reading);
  }
}

SkinReading SkinProbe::read(const HandPose& hand, const Object& object) {
  SkinReading reading;
  std::fill(through_m_.begin(), through_m_.end(), kNotMeasured);
  const double least = least_distance(hand, object);
  if (least > kTouch_m) {
    reading.lowest = least;
    walls_.forget();
    return reading;
  }
  pose_skin(*mesh_, hand, scale_, skin_, {});
  middles_.clear();
  for (const Cluster& cluster : clusters_) {
    middles_.push_back({&cluster, measure(cluster.first, object, reading)});
  }
  // Deepest first: what is found there leaves little to look for in the others.
  std::sort(middles_.begin(), middles_.end(), [](const MiddleReading& a, const MiddleReading& b) {
    return a.distance_m < b.distance_m;
  });
  for (const MiddleReading& middle : middles_) read_cluster(middle, object, reading);
  walls_.follow_palm(hand[Joint::palm].position, object);
  for (const MiddleReading& middle : middles_) follow_walls(middle, hand, object, reading);
  return reading;
}

}  // namespace nade
