#include "make_dog_life.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dog {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

enum BoneIndex : std::uint8_t { kHips, kChest, kNeck, kHead, kTail };
constexpr std::size_t kTailBones = 5;

/// Twenty breaths a minute. The chest widens more than it deepens.
constexpr double kBreathSeconds = 3.0;
constexpr double kBreathWide = 0.085;
constexpr double kBreathDeep = 0.045;
/// To one side and the other once a round, with a nod each time.
constexpr double kNeckTurn = 17.0 * kDegree;
constexpr double kHeadTurn = 14.0 * kDegree;
constexpr double kNod = 4.0 * kDegree;
/// A friendly wag, which runs down the tail; it dies down and comes up again once a round.
constexpr double kWagSeconds = 0.75;
constexpr double kWag = 10.0 * kDegree;
constexpr double kWagDelay = 0.35;  ///< radians from bone to bone

const Vec3 kNeckRoot(-0.130, 0.370, 0.0);
const Vec3 kNeckTop(-0.225, 0.512, 0.0);
constexpr std::array<double, kTailBones> kTailX{0.232, 0.272, 0.312, 0.348, 0.382};
constexpr std::array<double, kTailBones> kTailY{0.394, 0.388, 0.379, 0.380, 0.392};
constexpr double kTailBlend = 0.022;  ///< half of what a joint of the tail bends over

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * t * (t * (6.0 * t - 15.0) + 10.0);
}

/// 0 at the neck's root, 1 at its top, farther on the head.
double along_neck(const Vec3& point) {
  const Vec3 axis = kNeckTop - kNeckRoot;
  return (point - kNeckRoot).dot(axis) / axis.squaredNorm();
}

double chest_share(const Vec3& point) {
  return smooth_step(-0.23, -0.09, point.x()) * (1.0 - smooth_step(0.03, 0.17, point.x())) *
         smooth_step(0.20, 0.31, point.y());
}

/// Distance to the middle of the tail.
double from_tail(const Vec3& point) {
  std::size_t i = 0;
  while (i + 2 < kTailBones && point.x() > kTailX[i + 1]) ++i;
  const double t = (point.x() - kTailX[i]) / (kTailX[i + 1] - kTailX[i]);
  const double y = kTailY[i] + std::clamp(t, 0.0, 2.0) * (kTailY[i + 1] - kTailY[i]);
  return std::hypot(point.y() - y, point.z());
}

double tail_share(const Vec3& point) {
  // The rump's lower part is as far back as the tail's root, but far below it.
  return smooth_step(0.226, 0.290, point.x()) * (1.0 - smooth_step(0.045, 0.085, from_tail(point)));
}

Eigen::Quaterniond turned(double angle, const Vec3& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

/// Transforms of the bones from rest, at a time.
std::vector<Eigen::Affine3d> motions_at(double time_s) {
  const std::vector<BonePose> poses = life_at(time_s);
  std::vector<Eigen::Affine3d> motions;
  for (std::size_t i = 0; i < bones().size(); ++i) {
    const Bone& bone = bones()[i];
    Eigen::Affine3d motion = Eigen::Affine3d::Identity();
    if (bone.parent) motion = motions[*bone.parent];
    motion.translate(bone.position);
    motion.rotate(poses[i].rotation);
    motion.scale(poses[i].scale);
    motion.translate(-bone.position);
    motions.push_back(motion);
  }
  return motions;
}

Vec3 face_normal(const std::vector<Vec3>& points, const std::array<std::uint32_t, 3>& t) {
  return (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
}

}  // namespace

const std::vector<Bone>& bones() {
  static const std::vector<Bone> kAll = [] {
    std::vector<Bone> list{{"hips", {0.10, 0.36, 0.0}, std::nullopt},
                           {"chest", {-0.03, 0.352, 0.0}, kHips},
                           {"neck", {-0.150, 0.395, 0.0}, kHips},
                           {"head", {-0.212, 0.495, 0.0}, kNeck}};
    for (std::size_t i = 0; i < kTailBones; ++i) {
      list.push_back({"tail-" + std::to_string(i + 1),
                      {kTailX[i], kTailY[i], 0.0},
                      i == 0 ? std::size_t{kHips} : std::size_t{kTail} + i - 1});
    }
    return list;
  }();
  return kAll;
}

Carriers carriers_of(const Vec3& point) {
  std::vector<double> share(bones().size(), 0.0);
  const double u = along_neck(point);
  const double neck = smooth_step(0.05, 0.70, u);
  const double head = smooth_step(0.50, 0.94, u);
  const double tail = tail_share(point);
  const double chest = chest_share(point) * (1.0 - neck);
  share[kHips] = (1.0 - neck - chest) * (1.0 - tail);
  share[kChest] = chest;
  share[kNeck] = neck * (1.0 - head);
  share[kHead] = neck * head;
  double beyond = 1.0;  // what lies past the joints so far
  for (std::size_t i = kTailBones; i-- > 0;) {
    const double past =
        i == 0 ? 1.0 : smooth_step(kTailX[i] - kTailBlend, kTailX[i] + kTailBlend, point.x());
    share[kTail + i] = tail * beyond * past;
    beyond *= 1.0 - past;
  }
  std::vector<std::uint8_t> order(share.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint8_t>(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint8_t a, std::uint8_t b) { return share[a] > share[b]; });
  Carriers carriers;
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) sum += share[order[k]];
  for (std::size_t k = 0; k < 4; ++k) {
    const double weight = share[order[k]] / sum;
    if (weight < 1e-5) continue;
    carriers.bone[k] = order[k];
    carriers.weight[k] = static_cast<float>(weight);
  }
  return carriers;
}

std::vector<BonePose> life_at(double time_s) {
  std::vector<BonePose> poses(bones().size());
  const double round = 2.0 * kPi * time_s / kLifeSeconds;
  // In faster than out, as breath is.
  const double breath = 2.0 * kPi * time_s / kBreathSeconds;
  const double full = 0.5 * (1.0 - std::cos(breath + 0.35 * std::sin(breath)));
  poses[kChest].scale = {1.0, 1.0 + kBreathDeep * full, 1.0 + kBreathWide * full};
  // Dwells at either side.
  const double look = std::sin(round + 0.12 * std::sin(2.0 * round));
  const double nod = 0.5 * (1.0 - std::cos(2.0 * round));
  poses[kNeck].rotation = turned(kNeckTurn * look, Vec3::UnitY());
  poses[kHead].rotation = turned(kHeadTurn * look, Vec3::UnitY()) *
                          turned(kNod * nod, Vec3::UnitZ()) *
                          turned(0.5 * kNod * look, Vec3::UnitX());
  const double mood = 1.0 - std::pow(std::cos(0.5 * round), 4);
  const double wag = 2.0 * kPi * time_s / kWagSeconds;
  for (std::size_t i = 0; i < kTailBones; ++i) {
    const double delay = kWagDelay * static_cast<double>(i);
    poses[kTail + i].rotation = turned(kWag * mood * std::sin(wag - delay), Vec3::UnitY());
  }
  return poses;
}

std::optional<std::string> life_defect(const Mesh& mesh) {
  constexpr int kMoments = 48;
  std::vector<Carriers> carriers;
  for (const Vec3& point : mesh.points) carriers.push_back(carriers_of(point));
  for (int moment = 0; moment < kMoments; ++moment) {
    const double time_s = kLifeSeconds * moment / kMoments;
    const std::vector<Eigen::Affine3d> motions = motions_at(time_s);
    std::vector<Vec3> moved(mesh.points.size(), Vec3::Zero());
    for (std::size_t i = 0; i < moved.size(); ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        moved[i] += double{carriers[i].weight[k]} * (motions[carriers[i].bone[k]] * mesh.points[i]);
      }
    }
    for (const auto& triangle : mesh.triangles) {
      const Vec3 rest = face_normal(mesh.points, triangle);
      const Vec3 now = face_normal(moved, triangle);
      // Turned with the bone that carries it most.
      const Carriers& most = carriers[triangle[0]];
      const Vec3 carried = motions[most.bone[0]].linear() * rest;
      if (now.dot(carried) < 0.5 * now.norm() * carried.norm()) {
        return "a triangle turns more than 60 degrees against its bone after " +
               std::to_string(time_s) + " s";
      }
      const double growth = now.norm() / rest.norm();
      if (growth < 0.5 || growth > 2.0) {
        return "a triangle grows " + std::to_string(growth) + " times after " +
               std::to_string(time_s) + " s";
      }
    }
  }
  return std::nullopt;
}

}  // namespace dog
