#include "nade/flatten_skin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "nade/assert.h"
#include "nade/skin.h"
#include "ramps.h"
#include "skin_pieces.h"
#include "surface/near_objects.h"

namespace nade {
namespace {

using Vec3f = Eigen::Vector3f;

/// Flattened skin lies so far above the surface: neither flickers.
constexpr double kFlatHeight_m = 0.0002;
/// Skin nearer than this is drawn away from the surface a little, so that there is no crease.
constexpr double kBorder_m = 0.002;
/// Skin that is sunk so much deeper than its flesh gives way is moved less, and not at all.
constexpr double kDeep_m = 0.002;
constexpr double kTooDeep_m = 0.006;
constexpr double kWidestPiece_m = 0.01;
/// How much more than its normal the palmar axis counts for flesh that is not thin.
constexpr double kAlongAxis = 3.0;
constexpr double kThin_m = 0.0005;
constexpr double kThick_m = 0.002;
/// Pieces with their middles nearer than this have a say in where a vertex goes.
constexpr double kShareReach_m = 0.016;
/// Ways out begin to count from this height of a piece's inner point on, and fade so far before
/// they are out of reach.
constexpr double kSure_m = 0.006;
constexpr double kFarther_m = 0.008;
/// Of the pieces about a vertex so much has to agree on a way out: less where some are inside.
constexpr double kLeastAgreed = 0.02;
constexpr double kAgreed = 0.15;
/// Vertices are carried by other bones, too: so much farther from a piece than in the bind pose.
constexpr double kSlack_m = 0.006;

/// 0 for the palm, else a finger: one may be on this side of a board, the next on the other.
std::size_t limb_of(std::size_t bone) {
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const DigitJoints joints = joints_of(digit_at(d));
    if (bone > index_of(joints.metacarpal) && bone <= index_of(joints.tip)) return d + 1;
  }
  return 0;
}

/// How high skin is drawn that is so high, and how fast that grows: as it is from `kBorder_m` on,
/// `kFlatHeight_m` where it is sunk, and a parabola between.
struct Height {
  double value;
  double slope;
};
Height drawn_height(double gap_m) noexcept {
  const double half = 2.0 * (kBorder_m - kFlatHeight_m);
  const double in = gap_m - (kBorder_m - half);
  if (in <= 0.0) return {kFlatHeight_m, 0.0};
  if (in >= half) return {gap_m, 1.0};
  return {kFlatHeight_m + in * in / (2.0 * half), in / half};
}

/// The normal of skin whose height over a surface with the normal `up`, along `out`, has shrunk to
/// the share `kept`: skin that has none left faces the surface, whichever way it faced.
Vec3 turned(const Vec3& normal, const Vec3& up, const Vec3& out, double kept) noexcept {
  constexpr double kGrazing = 0.05;
  constexpr double kFacing = -0.1;
  const double facing = std::min(kFacing, out.dot(normal)) / std::max(kGrazing, out.dot(up));
  const Vec3 sum = kept * normal + (1.0 - kept) * facing * up;
  const double length = sum.norm();
  return length > 1e-6 ? Vec3(sum / length) : normal;
}

/// Where a point of the flesh is out of the surface, the unit direction from there to it; less of
/// it the nearer it is, none inside.
Vec3 way_out_of(const SurfacePoint& near, const Vec3& point) noexcept {
  const double height_m = near.signed_distance;
  if (!(height_m > 0.0)) return Vec3::Zero();
  return smoothstep(0.0, kSure_m, height_m) / height_m * (point - near.point);
}

}  // namespace

SkinFlattener::SkinFlattener(const HandMesh& mesh) : near_(std::make_unique<NearObjects>()) {
  NADE_ASSERT(mesh.normals.size() == mesh.vertices.size());
  flesh_m_ = measure_skin(mesh).flesh_depth_m;
  cut(mesh);
  share(mesh);
}
SkinFlattener::SkinFlattener(SkinFlattener&&) noexcept = default;
SkinFlattener& SkinFlattener::operator=(SkinFlattener&&) noexcept = default;
SkinFlattener::~SkinFlattener() = default;

void SkinFlattener::cut(const HandMesh& mesh) {
  // The palmar half of a bone's skin, and its back.
  std::map<std::pair<std::size_t, bool>, std::vector<std::size_t>> halves;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const std::size_t bone = heaviest(weights_of(mesh, i));
    const Vec3 back = mesh.bind.joints[bone].rotation * Vec3::UnitY();
    halves[{bone, back.dot(mesh.normals[i].cast<double>()) > 0.0}].push_back(i);
  }
  for (const auto& [half, skin] : halves) {
    for (std::vector<std::size_t>& vertices : split_skin(mesh, skin, kWidestPiece_m)) {
      Vec3 middle = Vec3::Zero();
      Vec3 out = Vec3::Zero();
      Piece piece;
      piece.bone = half.first;
      for (const std::size_t i : vertices) {
        middle += mesh.vertices[i].cast<double>() / static_cast<double>(vertices.size());
        out += mesh.normals[i].cast<double>();
        piece.flesh_m = std::max(piece.flesh_m, flesh_m_[i]);
      }
      for (const std::size_t i : vertices) {
        piece.radius_m =
            std::max(piece.radius_m, (mesh.vertices[i].cast<double>() - middle).norm());
      }
      const Pose& bind = mesh.bind.joints[piece.bone];
      piece.skin_local = bind.inverse().apply(middle);
      // Deep flesh goes in along the palmar axis also where its skin lies aslant.
      out.normalize();
      out += kAlongAxis * smoothstep(kThin_m, kThick_m, piece.flesh_m) *
             palmar_axis(mesh, joint_at(piece.bone), out);
      const double length = out.norm();
      if (length > 0.0) piece.inward_local = bind.rotation.conjugate() * (-out / length);
      piece.vertices = std::move(vertices);
      pieces_.push_back(std::move(piece));
    }
  }
}

void SkinFlattener::share(const HandMesh& mesh) {
  std::vector<std::uint32_t> own(mesh.vertices.size());
  for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
    for (const std::size_t i : pieces_[p].vertices) own[i] = p;
  }
  first_share_.push_back(0);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 at = mesh.vertices[i].cast<double>();
    const std::size_t limb = limb_of(pieces_[own[i]].bone);
    double sum = 0.0;
    for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
      const Piece& piece = pieces_[p];
      const std::size_t other = limb_of(piece.bone);
      if (other != limb && other != 0 && limb != 0) continue;
      const double away =
          (mesh.bind.joints[piece.bone].apply(piece.skin_local) - at).norm() / kShareReach_m;
      const double weight = away < 1.0 ? std::pow(1.0 - away * away, 2) : 0.0;
      if (weight > 0.0) shares_.push_back({p, weight});
      sum += weight;
    }
    for (std::size_t k = first_share_.back(); k < shares_.size(); ++k) shares_[k].weight /= sum;
    first_share_.push_back(static_cast<std::uint32_t>(shares_.size()));
  }
}

/// Hints are of one object.
void SkinFlattener::meet(const Object& object) noexcept {
  if (met_ == object.identity()) return;
  met_ = object.identity();
  for (Piece& piece : pieces_) piece.hint = {};
}

void SkinFlattener::find_ways_out(const Object& object, const HandPose& hand, double scale,
                                  double give_m) noexcept {
  for (Piece& piece : pieces_) {
    const Pose& bone = hand.joints[piece.bone];
    const double depth_m = piece.flesh_m + give_m + kTooDeep_m;
    piece.inner =
        bone.apply(scale * piece.skin_local) + depth_m * (bone.rotation * piece.inward_local);
    const double reach_m = depth_m + scale * piece.radius_m + kSlack_m + kBorder_m;
    const auto near = object.closest_point(piece.inner, reach_m, piece.hint);
    piece.height_m = near ? std::abs(near->signed_distance) : reach_m;
    piece.out = Vec3::Zero();
    if (!near) continue;
    const double in_reach = smoothstep(reach_m, reach_m - kSure_m, near->signed_distance);
    piece.out = in_reach * way_out_of(*near, piece.inner);
    const double unsure = 1.0 - smoothstep(0.0, kSure_m, near->signed_distance);
    if (unsure == 0.0) continue;
    // Flesh that lies aslant of the surface: a way out is farther in.
    const Vec3 farther = piece.inner + kFarther_m * (bone.rotation * piece.inward_local);
    if (const auto other = object.closest_point(farther, reach_m, piece.hint)) {
      piece.out += unsure * way_out_of(*other, farther);
    }
  }
}

Vec3 SkinFlattener::way_out(std::size_t vertex) const noexcept {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t k = first_share_[vertex]; k < first_share_[vertex + 1]; ++k) {
    sum += shares_[k].weight * pieces_[shares_[k].piece].out;
  }
  return sum;
}

void SkinFlattener::flatten(const Scene& scene, const HandPose& hand, double scale, double give_m,
                            std::span<const Vec3f> posed, std::span<Vec3f> flattened,
                            std::span<Vec3f> normals) noexcept {
  if (is_usable(hand)) near_->gather(scene, hand, nullptr);
  flatten(near_->object(), hand, scale, give_m, posed, flattened, normals);
}

void SkinFlattener::flatten(const Object& object, const HandPose& hand, double scale, double give_m,
                            std::span<const Vec3f> posed, std::span<Vec3f> flattened,
                            std::span<Vec3f> normals) noexcept {
  NADE_ASSERT(posed.size() == flesh_m_.size() && flattened.size() == posed.size());
  NADE_ASSERT(normals.empty() || normals.size() == posed.size());
  if (flattened.data() != posed.data()) {
    std::copy(posed.begin(), posed.end(), flattened.begin());
  }
  if (!is_usable(hand) || !std::isfinite(scale) || !(scale > 0.0) || !(give_m >= 0.0)) return;
  meet(object);
  find_ways_out(object, hand, scale, give_m);
  for (const Piece& piece : pieces_) {
    for (const std::size_t i : piece.vertices) {
      const Vec3 at = posed[i].cast<double>();
      // No surface is nearer to it.
      if (piece.height_m - (at - piece.inner).norm() > kBorder_m) continue;
      const Vec3 sum = way_out(i);
      const double agreed = sum.norm();
      if (!(agreed > kLeastAgreed)) continue;
      const Vec3 out = sum / agreed;
      const double above_m = flesh_m_[i] + give_m + kTooDeep_m;
      const auto hit = object.first_hit({at + above_m * out, -out, above_m + kBorder_m});
      if (!hit || hit->from_inside) continue;
      const double gap_m = hit->distance - above_m + give_m;
      const Height height = drawn_height(gap_m);
      if (height.slope == 1.0) continue;
      const double share = smoothstep(kLeastAgreed, kAgreed, agreed) *
                           smoothstep(0.0, kTooDeep_m - kDeep_m, hit->distance);
      flattened[i] = (at + share * (height.value - gap_m) * out).cast<float>();
      if (normals.empty()) continue;
      const double kept = 1.0 - share * (1.0 - height.slope);
      normals[i] = turned(normals[i].cast<double>(), hit->normal, out, kept).cast<float>();
    }
  }
}

}  // namespace nade
