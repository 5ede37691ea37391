#include "nade/flesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

#include "nade/assert.h"
#include "phalanx.h"
#include "skin_pieces.h"

namespace nade {
namespace {

/// Skin that one bone leads is cut every so far along the bone, then until no piece is wider.
constexpr double kSegment_m = 0.01;
constexpr double kWidest_m = 0.007;
/// Where all of a pad's skin faces one way, its middle lies this deep in the flesh.
constexpr double kMiddleDepth_m = 0.005;
/// A skin point sticks out if it is the farthest in one of so many directions.
constexpr int kDirections = 24;
/// A mesh with too many of them is thinned to vertices so far apart, or by this factor farther.
constexpr double kFinest_m = 0.002;
constexpr double kCoarser = 1.1;
/// Of the pads that one bone leads, those with a patch of palmar skin are so far apart.
constexpr double kPatchesApart_m = 0.009;
/// A patch with less palmar skin than this is left out.
constexpr double kSmallestPatchM2 = 5e-6;

using Indices = std::vector<std::size_t>;

Vec3 position_of(const HandMesh& mesh, std::size_t vertex) {
  return mesh.vertices[vertex].cast<double>();
}

Vec3 normal_of(const HandMesh& mesh, std::size_t vertex) {
  return mesh.normals[vertex].cast<double>();
}

/// Vertices no two of which are nearer than `apart_m`, or at the same place.
Indices spread_vertices(const HandMesh& mesh, double apart_m) {
  std::map<std::array<float, 3>, std::size_t> seen;
  Indices result;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Eigen::Vector3f& v = mesh.vertices[i];
    if (!seen.emplace(std::array{v.x(), v.y(), v.z()}, i).second) continue;
    const bool crowded =
        apart_m > 0.0 && std::any_of(result.begin(), result.end(), [&](std::size_t other) {
          return (position_of(mesh, i) - position_of(mesh, other)).norm() < apart_m;
        });
    if (!crowded) result.push_back(i);
  }
  return result;
}

std::optional<Part> patch_of(const HandMesh& mesh, const SkinDepths& depths, std::size_t vertex) {
  for (std::size_t i = 0; i < kPartCount; ++i) {
    if (is_in_patch(mesh, depths, part_at(i), vertex)) return part_at(i);
  }
  return std::nullopt;
}

FleshPoint attach(const HandPose& bind, const Vec3& position, JointWeights weights) {
  std::array<std::pair<std::size_t, double>, 4> most;
  double sum = 0.0;
  for (auto& [joint, weight] : most) {
    joint = heaviest(weights);
    weight = std::exchange(weights[joint], 0.0);
    sum += weight;
  }
  NADE_ASSERT(sum > 0.0);
  FleshPoint point;
  for (std::size_t k = 0; k < most.size(); ++k) {
    const auto [joint, weight] = most[k];
    point.attach(k, joint, weight / sum, bind.joints[joint].inverse().apply(position));
  }
  return point;
}

/// The vertices that are farthest out in some direction, evenly spread (a Fibonacci sphere).
Indices outermost(const HandMesh& mesh, const Indices& vertices) {
  std::vector<bool> kept(vertices.size(), false);
  for (int i = 0; i < kDirections; ++i) {
    const double y = 1.0 - (2.0 * i + 1.0) / kDirections;
    const double around = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - y * y);
    const Vec3 direction(r * std::cos(around), y, r * std::sin(around));
    const auto farthest =
        std::max_element(vertices.begin(), vertices.end(), [&](std::size_t a, std::size_t b) {
          return direction.dot(position_of(mesh, a)) < direction.dot(position_of(mesh, b));
        });
    kept[static_cast<std::size_t>(farthest - vertices.begin())] = true;
  }
  Indices result;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (kept[i]) result.push_back(vertices[i]);
  }
  return result;
}

/// A hand cut into pads, and the vertex of each skin point.
struct CutHand {
  HandFlesh flesh;
  Indices vertices;
};

void add_pad(const HandMesh& mesh, const Indices& vertices, std::optional<Part> part,
             CutHand& cut) {
  HandFlesh& flesh = cut.flesh;
  Vec3 middle = Vec3::Zero();
  JointWeights weights{};
  const double share = 1.0 / static_cast<double>(vertices.size());
  for (const std::size_t vertex : vertices) {
    middle += share * (position_of(mesh, vertex) - kMiddleDepth_m * normal_of(mesh, vertex));
    const JointWeights own = weights_of(mesh, vertex);
    for (std::size_t j = 0; j < kJointCount; ++j) weights[j] += own[j];
  }
  FleshPad& pad = flesh.pads.emplace_back();
  pad.part = part;
  pad.middle = attach(mesh.bind, middle, weights);
  pad.first = static_cast<std::uint32_t>(flesh.skin.size());
  for (const std::size_t vertex : outermost(mesh, vertices)) {
    const Vec3 position = position_of(mesh, vertex);
    pad.radius_m = std::max(pad.radius_m, (position - middle).norm());
    flesh.skin.push_back(attach(mesh.bind, position, weights_of(mesh, vertex)));
    cut.vertices.push_back(vertex);
  }
  pad.count = static_cast<std::uint32_t>(flesh.skin.size()) - pad.first;
}

CutHand cut_up(const HandMesh& mesh, const Indices& kept) {
  CutHand cut;
  HandFlesh& flesh = cut.flesh;
  flesh.side = mesh.side;
  flesh.hand_length_m = hand_length(mesh.bind);
  const SkinDepths depths = measure_skin_depths(mesh);
  struct Group {
    int part;  ///< -1: of no patch
    int joint;
    int segment;
    bool operator<(const Group& other) const {
      return std::tie(part, joint, segment) < std::tie(other.part, other.joint, other.segment);
    }
  };
  std::map<Group, Indices> groups;
  for (const std::size_t vertex : kept) {
    const std::size_t joint = heaviest(weights_of(mesh, vertex));
    Group group{-1, static_cast<int>(joint), 0};
    if (const std::optional<Part> part = patch_of(mesh, depths, vertex)) {
      group.part = static_cast<int>(*part);
      if (part == Part::palm) group.joint = 0;
    } else {
      const Vec3 local = mesh.bind.joints[joint].inverse().apply(position_of(mesh, vertex));
      group.segment = static_cast<int>(std::floor(-local.z() / kSegment_m));
    }
    groups[group].push_back(vertex);
  }
  for (const auto& [group, vertices] : groups) {
    std::optional<Part> part;
    if (group.part >= 0) part = part_at(static_cast<std::size_t>(group.part));
    for (const Indices& piece : split_skin(mesh, vertices, kWidest_m))
      add_pad(mesh, piece, part, cut);
  }
  return cut;
}

/// Palmar skin as it is gathered for a pad.
struct PatchSum {
  Vec3 moment = Vec3::Zero();
  double area_m2 = 0.0;
  JointWeights weights{};
  std::array<double, kSkinRegionCount> by_region{};
};

std::size_t nearest_pad(const HandFlesh& flesh, const Indices& pads, const std::vector<Vec3>& skin,
                        const Vec3& point) {
  std::size_t nearest = pads.front();
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t p : pads) {
    const FleshPad& pad = flesh.pads[p];
    for (std::uint32_t k = pad.first; k < pad.first + pad.count; ++k) {
      const double distance = (skin[k] - point).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      nearest = p;
    }
  }
  return nearest;
}

/// Of some pads, by number, each takes the palmar skin that is nearest to it.
std::vector<PatchSum> gather_patches(const HandMesh& mesh, const SkinMap& skin,
                                     const std::vector<Vec3>& places, const HandFlesh& flesh,
                                     const Indices& pads) {
  std::vector<PatchSum> sums(flesh.pads.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const double area_m2 = skin.area_m2[i];
    if (!skin.is_palmar(i) || area_m2 == 0.0) continue;
    const Vec3 at = position_of(mesh, i);
    PatchSum& sum = sums[nearest_pad(flesh, pads, places, at)];
    sum.moment += area_m2 * at;
    sum.area_m2 += area_m2;
    sum.by_region[static_cast<std::size_t>(skin.region[i])] += area_m2;
    const JointWeights weights = weights_of(mesh, i);
    for (std::size_t j = 0; j < kJointCount; ++j) sum.weights[j] += area_m2 * weights[j];
  }
  return sums;
}

/// Pads well apart, those with the most palmar skin first.
Indices pads_apart(const HandMesh& mesh, const HandFlesh& flesh,
                   const std::vector<PatchSum>& sums) {
  const auto middle_of = [&](std::size_t p) {
    return position_of(flesh.pads[p].middle, mesh.bind, 1.0);
  };
  Indices by_area;
  for (std::size_t p = 0; p < sums.size(); ++p) {
    if (sums[p].area_m2 >= kSmallestPatchM2) by_area.push_back(p);
  }
  std::stable_sort(by_area.begin(), by_area.end(),
                   [&](std::size_t a, std::size_t b) { return sums[a].area_m2 > sums[b].area_m2; });
  Indices apart;
  for (const std::size_t p : by_area) {
    const bool crowded = std::any_of(apart.begin(), apart.end(), [&](std::size_t other) {
      return flesh.pads[p].middle.joints[0] == flesh.pads[other].middle.joints[0] &&
             (middle_of(p) - middle_of(other)).norm() < kPatchesApart_m;
    });
    if (!crowded) apart.push_back(p);
  }
  return apart;
}

/// Gives the palmar skin to pads well apart, each what is nearest to it.
void add_patches(const HandMesh& mesh, const SkinMap& skin, const std::vector<Vec3>& places,
                 HandFlesh& flesh) {
  Indices all(flesh.pads.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const Indices apart = pads_apart(mesh, flesh, gather_patches(mesh, skin, places, flesh, all));
  if (apart.empty()) return;
  const std::vector<PatchSum> sums = gather_patches(mesh, skin, places, flesh, apart);
  for (const std::size_t p : apart) {
    const PatchSum& sum = sums[p];
    if (sum.area_m2 < kSmallestPatchM2) continue;
    const auto most = std::max_element(sum.by_region.begin(), sum.by_region.end());
    flesh.pads[p].palmar =
        PalmarPatch{attach(mesh.bind, sum.moment / sum.area_m2, sum.weights), sum.area_m2,
                    static_cast<SkinRegion>(most - sum.by_region.begin())};
  }
}

/// How deep the flesh is, how thick the phalanges, and where the palmar skin.
void add_skin(const HandMesh& mesh, CutHand& cut) {
  const SkinMap skin = measure_skin(mesh);
  std::vector<Vec3> places;
  for (const std::size_t vertex : cut.vertices) {
    places.push_back(position_of(mesh, vertex));
    cut.flesh.depth_m.push_back(skin.flesh_depth_m[vertex]);
  }
  cut.flesh.phalanx_radius_m = phalanx_radii(mesh.bind, places);
  add_patches(mesh, skin, places, cut.flesh);
}

}  // namespace

Vec3 position_of(const FleshPoint& point, const HandPose& hand, double scale) noexcept {
  const Vec3& palm = hand[Joint::palm].position;  // floats are coarse far from the origin
  Vec3 sum = palm;
  for (std::size_t k = 0; k < point.joints.size() && point.shares[k].w() > 0.0F; ++k) {
    const Pose& joint = hand.joints[point.joints[k]];
    const Eigen::Vector4d share = point.shares[k].cast<double>();
    sum += joint.rotation * (scale * share.head<3>()) + share.w() * (joint.position - palm);
  }
  return sum;
}

HandFlesh measure_flesh(const HandMesh& mesh) {
  CutHand cut = cut_up(mesh, spread_vertices(mesh, 0.0));
  for (double apart_m = kFinest_m; cut.flesh.skin.size() > kMostSkinPoints; apart_m *= kCoarser) {
    cut = cut_up(mesh, spread_vertices(mesh, apart_m));
  }
  add_skin(mesh, cut);
  return std::move(cut.flesh);
}

}  // namespace nade
