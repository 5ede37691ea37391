#include "nade/skin.h"

#include <algorithm>
#include <array>
#include <map>

#include "nade/assert.h"
#include "ramps.h"
#include "skin_pieces.h"

namespace nade {
namespace {

constexpr double kFacing = 0.5;  // cosine
constexpr double kThinnest_m = 0.0005;
/// Of the way from wrist to middle knuckle: the forearm's stump lies before it.
constexpr double kStump = -0.12;

/// By region. A fingertip gives 2 mm at 1 N and hardly more beyond; what exceeds that stands for
/// the palm's giving.
constexpr std::array<double, kSkinRegionCount> kMostFlesh_m{0.003, 0.005, 0.012, 0.005,
                                                            0.012, 0.005, 0.0005};

/// A place on the palm: 0 to 1 from the wrist to the middle knuckle, and aside from the middle
/// of index and little knuckle, in their distance, positive to the index.
struct PalmPlace {
  double along;
  double aside;
};

class PalmMap {
 public:
  explicit PalmMap(const HandPose& bind)
      : wrist_(bind[Joint::wrist].position),
        along_(bind[Joint::middle_proximal].position - wrist_),
        middle_(0.5 *
                (bind[Joint::index_proximal].position + bind[Joint::little_proximal].position)),
        aside_(bind[Joint::index_proximal].position - bind[Joint::little_proximal].position) {}

  [[nodiscard]] PalmPlace place_of(const Vec3& point) const {
    return {(point - wrist_).dot(along_) / along_.squaredNorm(),
            (point - middle_).dot(aside_) / aside_.squaredNorm()};
  }

 private:
  Vec3 wrist_;
  Vec3 along_;
  Vec3 middle_;
  Vec3 aside_;
};

/// Vertices at one place, as on a seam, are as deep as the deepest of them.
void join_depths(const HandMesh& mesh, std::vector<double>& depth_m) {
  std::map<std::array<float, 3>, double> deepest;
  const auto place_of = [&](std::size_t i) {
    const Eigen::Vector3f& at = mesh.vertices[i];
    return std::array{at.x(), at.y(), at.z()};
  };
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    double& depth = deepest[place_of(i)];
    depth = std::max(depth, depth_m[i]);
  }
  for (std::size_t i = 0; i < depth_m.size(); ++i) depth_m[i] = deepest[place_of(i)];
}

SkinRegion palm_region(const PalmPlace& place) {
  if (place.along > 0.8) return SkinRegion::knuckles;
  if (place.along < 0.4 || place.aside < -0.1) return SkinRegion::heel;
  return SkinRegion::hollow;
}

/// Whichever way the skin faces.
SkinRegion region_at(Joint bone, const PalmPlace& place) {
  switch (bone) {
    case Joint::thumb_metacarpal:
    case Joint::thumb_proximal:
      return SkinRegion::thenar;
    case Joint::index_proximal:
    case Joint::index_intermediate:
    case Joint::middle_proximal:
    case Joint::middle_intermediate:
    case Joint::ring_proximal:
    case Joint::ring_intermediate:
    case Joint::little_proximal:
    case Joint::little_intermediate:
      return SkinRegion::finger;
    case Joint::palm:
    case Joint::wrist:
    case Joint::index_metacarpal:
    case Joint::middle_metacarpal:
    case Joint::ring_metacarpal:
    case Joint::little_metacarpal:
      return palm_region(place);
    default:
      return SkinRegion::tip;
  }
}

}  // namespace

std::string_view name_of(SkinRegion region) {
  constexpr std::array<std::string_view, kSkinRegionCount> kRegionNames{
      "tip", "finger", "thenar", "knuckles", "heel", "hollow", "back"};
  return kRegionNames[static_cast<std::size_t>(region)];
}

SkinMap measure_skin(const HandMesh& mesh) {
  const std::size_t count = mesh.vertices.size();
  NADE_ASSERT(mesh.normals.size() == count);
  SkinMap skin;
  skin.region.reserve(count);
  skin.flesh_depth_m.reserve(count);
  const PalmMap palm(mesh.bind);
  for (std::size_t i = 0; i < count; ++i) {
    const Joint bone = joint_at(heaviest(weights_of(mesh, i)));
    const PalmPlace place = palm.place_of(mesh.vertices[i].cast<double>());
    const SkinRegion region = region_at(bone, place);
    const Vec3 normal = mesh.normals[i].cast<double>();
    const double facing = normal.dot(palmar_axis(mesh, bone, normal));
    const bool palmar = facing > kFacing && place.along >= kStump;
    skin.region.push_back(palmar ? region : SkinRegion::back);
    skin.flesh_depth_m.push_back(
        kThinnest_m + smoothstep(0.0, kFacing, facing) *
                          (kMostFlesh_m[static_cast<std::size_t>(region)] - kThinnest_m));
  }
  join_depths(mesh, skin.flesh_depth_m);
  skin.area_m2.assign(count, 0.0);
  for (const auto& triangle : mesh.triangles) {
    const Vec3 corner = mesh.vertices[triangle[0]].cast<double>();
    const Vec3 b = mesh.vertices[triangle[1]].cast<double>() - corner;
    const Vec3 c = mesh.vertices[triangle[2]].cast<double>() - corner;
    for (const std::uint32_t vertex : triangle) skin.area_m2[vertex] += b.cross(c).norm() / 6.0;
  }
  return skin;
}

}  // namespace nade
