// Frames that no tracker should send, on each kind of surface.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "byte_reader.h"
#include "input_file.h"
#include "nade/corrector.h"
#include "nade/mesh.h"
#include "nade/surface_group.h"
#include "support/hand_checks.h"
#include "support/meshes.h"
#include "support/sample_hand.h"

namespace {

using namespace nade;
using fuzz::ByteReader;

/// Every third number is any bit pattern.
double hostile_number(ByteReader& bytes) {
  const auto kind = bytes.take<std::uint8_t>();
  return kind % 3 == 0 ? bytes.take<double>() : bytes.within(0.3);
}

Pose hostile_pose(ByteReader& bytes) {
  Pose pose;
  for (Eigen::Index i = 0; i < 3; ++i) pose.position[i] = hostile_number(bytes);
  for (Eigen::Index i = 0; i < 4; ++i) pose.rotation.coeffs()[i] = hostile_number(bytes);
  return pose;
}

/// A hand over the object that goes on by a few millimetres, or something else.
HandPose hostile_hand(ByteReader& bytes, Vec3& palm) {
  const auto kind = bytes.take<std::uint8_t>();
  palm += Vec3(bytes.within(0.01), bytes.within(0.01), bytes.within(0.01));
  HandAngles angles = test::relaxed_angles();
  angles[kind % kDigitCount][1].flexion = bytes.within(1.5);
  const Quat turn(Eigen::AngleAxisd(bytes.within(0.6), Vec3::UnitX()));
  const Handedness side = kind > 250 ? Handedness::left : Handedness::right;
  HandPose hand = test::placed_hand(test::sample_hand(side, angles), palm, turn);
  for (int joints = kind % 8 == 0 ? 3 : 0; joints > 0; --joints) {
    hand.joints[bytes.take<std::uint8_t>() % kJointCount] = hostile_pose(bytes);
  }
  if (kind % 16 == 1) hand = moved(hand, {hostile_pose(bytes).position, Quat::Identity()});
  return hand;
}

/// What the hand is on; the mesh deforms.
class Objects {
 public:
  Objects()
      : soup_(test::subdivided(test::box_mesh({0.1F, 0.02F, 0.1F}), 2)),
        mesh_(std::move(MeshSurface::build(soup_, "box").value())),
        group_({Object(plane_), Object(ball_), Object(*mesh_)}) {}

  [[nodiscard]] const Surface& pick(std::uint8_t number) const {
    const std::array<const Surface*, 4> all{&plane_, &ball_, mesh_.get(), &group_};
    return *all[number % all.size()];
  }

  void deform(ByteReader& bytes) {
    Eigen::Vector3f& vertex = soup_.vertices[bytes.take<std::uint8_t>() % soup_.vertices.size()];
    for (Eigen::Index i = 0; i < 3; ++i) vertex[i] = static_cast<float>(hostile_number(bytes));
    mesh_->refit(soup_.vertices);
  }

 private:
  PlaneSurface plane_;
  SphereSurface ball_{0.05};
  TriangleSoup soup_;
  std::unique_ptr<MeshSurface> mesh_;
  SurfaceGroup group_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ByteReader bytes(data, size);
  const auto kind = bytes.take<std::uint8_t>();
  CorrectorOptions options;
  options.method = kind % 2 == 0 ? Method::paper : Method::nade;
  options.settle.softness_m = kind % 4 < 2 ? 0.0 : 0.01;
  HandCorrector corrector(options);
  Objects objects;
  const Surface& surface = objects.pick(static_cast<std::uint8_t>(kind / 4));
  Placement placement;
  Vec3 palm(0.0, 0.03, 0.0);
  std::int64_t time_ns = 0;
  while (!bytes.empty()) {
    const auto change = bytes.take<std::uint8_t>();
    if (change % 16 == 1) objects.deform(bytes);
    if (change % 16 == 2) placement = {hostile_pose(bytes), hostile_number(bytes)};
    if (change % 16 == 3) placement = {};
    time_ns = change % 16 == 4 ? bytes.take<std::int64_t>() : time_ns + 1'000'000 * (change / 8);
    const HandPose hand = hostile_hand(bytes, palm);
    const CorrectedHand& drawn = corrector.update(hand, Object(surface, placement), time_ns);
    if (is_usable(hand)) {
      fuzz::demand(test::all_finite(drawn.pose));
    } else {
      fuzz::demand(drawn.status == HandStatus::untracked);
    }
  }
  return 0;
}
