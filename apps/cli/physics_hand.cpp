#include "physics_hand.h"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btShapeHull.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointLimitConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointMotor.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "nade/eval/wrist_offset.h"
#include "nade/skeleton.h"

namespace nade::cli {
namespace {

// The best of 17 settings by penetration, gap and pops on plane, ball and dog: weaker motors let
// the fingers be flung about, a faster drive makes the palm tremble on meshes.
constexpr int kSubsteps = 4;  // of a frame
constexpr int kSolverIterations = 30;
constexpr double kPalmMass_kg = 1.0;
constexpr double kBoneMass_kg = 0.03;
constexpr double kKnuckleMass_kg = 0.005;
constexpr btScalar kKnuckleInertia = btScalar(2e-6);
constexpr double kCatchUp_hz = 60.0;  // of the palm's drive
constexpr double kCatchUpMax_mps = 0.4;
constexpr double kCatchUpMaxTurn_radps = 3.0;
constexpr double kMotorTorque_nm = 1.0;
constexpr double kMotorMax_radps = 10.0;
constexpr btScalar kInertiaTimes = btScalar(10);  // so that bones are not flung by a touch
constexpr double kMargin_m = 0.0005;
constexpr double kGhostDistance_m = 0.1;
constexpr double kPause_s = 0.2;  // after which the hand starts anew
constexpr double kFrameMin_s = 1e-3;
constexpr int kHandGroup = 2;
constexpr int kObjectGroup = 1;
constexpr std::size_t kLinksPerDigit = 4;  // base flexion, base abduction, middle, last flexion
constexpr std::size_t kLinks = kDigitCount * kLinksPerDigit;
/// The freedom of each link, in a chain's order of freedoms.
constexpr std::array<Eigen::Index, kLinksPerDigit> kFreedom{1, 0, 2, 3};

btVector3 to_bullet(const Vec3& v) {
  const Eigen::Matrix<btScalar, 3, 1> f = v.cast<btScalar>();
  return {f.x(), f.y(), f.z()};
}
btTransform to_bullet(const Pose& pose) {
  const Eigen::Quaternion<btScalar> q = pose.rotation.cast<btScalar>();
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), to_bullet(pose.position));
}
Pose from_bullet(const btTransform& transform) {
  const btQuaternion q = transform.getRotation();
  const btVector3& p = transform.getOrigin();
  return {Vec3(p.x(), p.y(), p.z()), Quat(q.w(), q.x(), q.y(), q.z()).normalized()};
}

/// The turn vector that takes one rotation to another, world.
Vec3 turn_between(const Quat& from, const Quat& to) {
  Quat turn = to * from.conjugate();
  if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
  const Eigen::AngleAxisd angle_axis{Eigen::Quaterniond(turn)};
  return angle_axis.angle() * angle_axis.axis();
}

Vec3 shortened(const Vec3& v, double longest) {
  const double length = v.norm();
  return length > longest ? Vec3(v * (longest / length)) : v;
}

/// What the object is to Bullet, where it stands.
struct Obstacle {
  std::unique_ptr<btTriangleMesh> triangles;
  std::unique_ptr<btCollisionShape> shape;
  btCollisionObject body;
};

std::unique_ptr<Obstacle> make_obstacle(const LoadedObject& object, const Placement& placement) {
  auto obstacle = std::make_unique<Obstacle>();
  const Placement whole = composed(placement, object.base);
  if (dynamic_cast<const PlaneSurface*>(object.surface.get()) != nullptr) {
    obstacle->shape = std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0));
    obstacle->body.setWorldTransform(to_bullet(whole.pose));
  } else if (const auto* ball = dynamic_cast<const SphereSurface*>(object.surface.get())) {
    obstacle->shape =
        std::make_unique<btSphereShape>(static_cast<btScalar>(whole.scale * ball->radius()));
    obstacle->body.setWorldTransform(to_bullet(whole.pose));
  } else if (object.soup) {
    obstacle->triangles = std::make_unique<btTriangleMesh>();
    const auto corner = [&](std::uint32_t i) {
      return to_bullet(placement.to_world(object.soup->vertices[i].cast<double>()));
    };
    for (const auto& [a, b, c] : object.soup->triangles) {
      obstacle->triangles->addTriangle(corner(a), corner(b), corner(c));
    }
    obstacle->shape = std::make_unique<btBvhTriangleMeshShape>(obstacle->triangles.get(), true);
    obstacle->shape->setMargin(static_cast<btScalar>(kMargin_m));
  } else {
    return nullptr;
  }
  obstacle->body.setCollisionShape(obstacle->shape.get());
  obstacle->body.setFriction(0);
  return obstacle;
}

/// A point of the skin as its heaviest joint's frame has it, in the mesh's own size.
Vec3 local_of(const FleshPoint& point) {
  const Eigen::Vector4f& share = point.shares[0];
  return (share.head<3>() / share.w()).cast<double>();
}

/// A bone's thickness: the median distance of its skin from its axis, metres.
double bone_radius(const HandFlesh& flesh, Joint joint, double scale) {
  std::vector<double> distances;
  for (const FleshPoint& point : flesh.skin) {
    if (point.joints[0] != index_of(joint)) continue;
    const Vec3 local = local_of(point);
    distances.push_back(std::hypot(local.x(), local.y()));
  }
  if (distances.empty()) return 0.007 * scale;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return scale * *middle;
}

/// Whether a joint belongs to the palm's body.
bool is_palm(Joint joint) {
  return joint == Joint::palm || joint == Joint::wrist || joint == Joint::index_metacarpal ||
         joint == Joint::middle_metacarpal || joint == Joint::ring_metacarpal ||
         joint == Joint::little_metacarpal;
}

/// The simulated hand: bodies, joints and the world that they share with the object.
class HandBodies {
 public:
  HandBodies(const HandPose& hand, const HandFlesh& flesh, double scale, Obstacle& obstacle)
      : world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    world_.setGravity(btVector3(0, 0, 0));
    world_.getSolverInfo().m_numIterations = kSolverIterations;
    world_.addCollisionObject(&obstacle.body, kObjectGroup, kHandGroup);
    palm_ = hand[Joint::palm];
    btCollisionShape& palm_shape = add_palm_shape(hand, flesh, scale);
    btVector3 inertia;
    palm_shape.calculateLocalInertia(static_cast<btScalar>(kPalmMass_kg), inertia);
    body_ = std::make_unique<btMultiBody>(
        static_cast<int>(kLinks), static_cast<btScalar>(kPalmMass_kg), inertia, false, false);
    body_->setBaseWorldTransform(to_bullet(palm_));
    std::array<btCollisionShape*, kLinks> shapes{};
    for (std::size_t d = 0; d < kDigitCount; ++d) {
      setup_digit(measure_chain(hand, digit_at(d)), flesh, scale, shapes);
    }
    body_->finalizeMultiDof();
    body_->setHasSelfCollision(false);
    body_->setUseGyroTerm(false);
    body_->setLinearDamping(0);
    body_->setAngularDamping(0);
    world_.addMultiBody(body_.get(), kHandGroup, kObjectGroup);
    body_->setBaseCollider(add_collider(-1, palm_shape));
    for (std::size_t i = 0; i < kLinks; ++i) {
      const int link = static_cast<int>(i);
      if (shapes[i] != nullptr) body_->getLink(link).m_collider = add_collider(link, *shapes[i]);
      add_drive(i);
    }
    btAlignedObjectArray<btQuaternion> rotations;
    btAlignedObjectArray<btVector3> places;
    body_->forwardKinematics(rotations, places);
    body_->updateCollisionObjectWorldTransforms(rotations, places);
  }
  ~HandBodies() {
    for (auto& drive : drives_) world_.removeMultiBodyConstraint(drive.get());
    for (auto& collider : colliders_) world_.removeCollisionObject(collider.get());
    world_.removeMultiBody(body_.get());
    while (world_.getNumCollisionObjects() > 0) {
      world_.removeCollisionObject(world_.getCollisionObjectArray()[0]);
    }
  }
  HandBodies(const HandBodies&) = delete;
  HandBodies& operator=(const HandBodies&) = delete;

  /// Chases `to`, where the hand was at `from` one frame before.
  void chase(const HandPose& from, const HandPose& to, double seconds) {
    const double step_s = seconds / kSubsteps;
    const HandAngles angles_to = measure_angles(to);
    const HandAngles angles_from = measure_angles(from);
    const Pose& a = from[Joint::palm];
    const Pose& b = to[Joint::palm];
    const Vec3 tracked_speed = (b.position - a.position) / seconds;
    const Vec3 tracked_turn = turn_between(a.rotation, b.rotation) / seconds;
    for (int step = 1; step <= kSubsteps; ++step) {
      const double share = static_cast<double>(step) / kSubsteps;
      const double before = static_cast<double>(step - 1) / kSubsteps;
      const Pose here = palm();
      // The tracked hand's own motion, and what it takes to catch up with it.
      const Vec3 lag = a.position + before * (b.position - a.position) - here.position;
      const Vec3 turned = turn_between(here.rotation, a.rotation.slerp(before, b.rotation));
      body_->setBaseVel(to_bullet(tracked_speed + shortened(kCatchUp_hz * lag, kCatchUpMax_mps)));
      body_->setBaseOmega(
          to_bullet(tracked_turn + shortened(kCatchUp_hz * turned, kCatchUpMaxTurn_radps)));
      for (std::size_t d = 0; d < kDigitCount; ++d) {
        const DigitFreedoms first = freedoms_of(angles_from[d]);
        const DigitFreedoms now = first + share * (freedoms_of(angles_to[d]) - first);
        for (std::size_t i = 0; i < kLinksPerDigit; ++i) {
          const std::size_t link = d * kLinksPerDigit + i;
          motors_[link]->setPositionTarget(
              static_cast<btScalar>(now[kFreedom[i]] - start_[d][kFreedom[i]]));
          motors_[link]->setMaxAppliedImpulse(static_cast<btScalar>(kMotorTorque_nm * step_s));
        }
      }
      world_.stepSimulation(static_cast<btScalar>(step_s), 0);
    }
  }

  [[nodiscard]] Pose palm() const { return from_bullet(body_->getBaseWorldTransform()); }

  /// The bodies' pose as a hand with the tracked hand's bones.
  [[nodiscard]] HandPose pose_of(const HandPose& tracked) const {
    HandPose hand = moved(tracked, palm() * tracked[Joint::palm].inverse());
    for (std::size_t d = 0; d < kDigitCount; ++d) {
      const DigitChain chain = measure_chain(hand, digit_at(d));
      DigitFreedoms freedoms = start_[d];
      for (std::size_t i = 0; i < kLinksPerDigit; ++i) {
        freedoms[kFreedom[i]] +=
            static_cast<double>(body_->getJointPos(static_cast<int>(d * kLinksPerDigit + i)));
      }
      set_digit(hand, digit_at(d), pose_chain(chain, with_freedoms(chain.angles, freedoms)));
    }
    return hand;
  }

 private:
  btCollisionShape& add_palm_shape(const HandPose& hand, const HandFlesh& flesh, double scale) {
    auto hull = std::make_unique<btConvexHullShape>();
    const Pose to_palm = palm_.inverse();
    for (const FleshPoint& point : flesh.skin) {
      const Joint joint = joint_at(point.joints[0]);
      if (!is_palm(joint)) continue;
      const Vec3 world = hand[joint].apply(scale * local_of(point));
      hull->addPoint(to_bullet(to_palm.apply(world)), false);
    }
    hull->setMargin(static_cast<btScalar>(kMargin_m));
    btShapeHull fewer(hull.get());
    fewer.buildHull(static_cast<btScalar>(kMargin_m));
    auto palm = std::make_unique<btConvexHullShape>();
    for (int i = 0; i < fewer.numVertices(); ++i) {
      palm->addPoint(fewer.getVertexPointer()[i], false);
    }
    palm->setMargin(static_cast<btScalar>(kMargin_m));
    palm->recalcLocalAabb();
    shapes_.push_back(std::move(palm));
    return *shapes_.back();
  }

  /// A capsule along `bone`, about its middle, all in the palm's frame.
  btCollisionShape& add_bone_shape(const Vec3& bone, double radius_m) {
    auto capsule = std::make_unique<btCapsuleShape>(static_cast<btScalar>(radius_m),
                                                    static_cast<btScalar>(bone.norm()));
    auto turned = std::make_unique<btCompoundShape>(false);
    turned->addChildShape(to_bullet(Pose{Vec3::Zero(), Quat::FromTwoVectors(Vec3::UnitY(), bone)}),
                          capsule.get());
    shapes_.push_back(std::move(capsule));
    shapes_.push_back(std::move(turned));
    return *shapes_.back();
  }

  /// Every link's frame lies as the palm's in the first frame, where all its joints are at zero.
  void setup_digit(const DigitChain& chain, const HandFlesh& flesh, double scale,
                   std::array<btCollisionShape*, kLinks>& shapes) {
    const std::size_t digit = index_of(chain.digit);
    const DigitAxes axes = chain_axes(chain, chain.angles);
    const Pose to_palm = palm_.inverse();
    const auto direction = [&](const Vec3& world) { return Vec3(to_palm.rotation * world); };
    start_[digit] = freedoms_of(chain.angles);
    Vec3 parent_com = Vec3::Zero();
    int parent = -1;
    for (std::size_t i = 0; i < kLinksPerDigit; ++i) {
      const auto freedom = static_cast<std::size_t>(kFreedom[i]);
      const std::size_t link = digit * kLinksPerDigit + i;
      const Vec3 pivot = to_palm.apply(axes.center[freedom]);
      Vec3 com = pivot;
      double mass = kKnuckleMass_kg;
      btVector3 inertia(kKnuckleInertia, kKnuckleInertia, kKnuckleInertia);
      if (i > 0) {  // the first only turns; the second bears the bone
        const Vec3 end = to_palm.apply(i + 1 < kLinksPerDigit ? axes.center[i + 1] : axes.tip);
        const Joint joint = hinge_joint(chain.digit, i - 1);
        shapes[link] = &add_bone_shape(end - pivot, bone_radius(flesh, joint, scale));
        com = 0.5 * (pivot + end);
        mass = kBoneMass_kg;
        shapes[link]->calculateLocalInertia(static_cast<btScalar>(mass), inertia);
        inertia *= kInertiaTimes;
      }
      body_->setupRevolute(static_cast<int>(link), static_cast<btScalar>(mass), inertia, parent,
                           btQuaternion::getIdentity(), to_bullet(direction(axes.axis[freedom])),
                           to_bullet(Vec3(pivot - parent_com)), to_bullet(Vec3(com - pivot)), true);
      parent = static_cast<int>(link);
      parent_com = com;
    }
  }

  btMultiBodyLinkCollider* add_collider(int link, btCollisionShape& shape) {
    auto collider = std::make_unique<btMultiBodyLinkCollider>(body_.get(), link);
    collider->setCollisionShape(&shape);
    collider->setFriction(0);
    world_.addCollisionObject(collider.get(), kHandGroup, kObjectGroup);
    colliders_.push_back(std::move(collider));
    return colliders_.back().get();
  }

  void add_drive(std::size_t link) {
    const std::size_t digit = link / kLinksPerDigit;
    const std::size_t i = link % kLinksPerDigit;
    const HingeRange range = range_of_motion(digit_at(digit), i < 2 ? 0 : i - 1);
    const double start = start_[digit][kFreedom[i]];
    const double low = std::min(0.0, (i == 1 ? range.abduction_min : range.flexion_min) - start);
    const double high = std::max(0.0, (i == 1 ? range.abduction_max : range.flexion_max) - start);
    auto motor = std::make_unique<btMultiBodyJointMotor>(body_.get(), static_cast<int>(link),
                                                         btScalar(0), btScalar(1));
    motor->setRhsClamp(static_cast<btScalar>(kMotorMax_radps));
    motors_[link] = motor.get();
    drives_.push_back(std::move(motor));
    drives_.push_back(std::make_unique<btMultiBodyJointLimitConstraint>(
        body_.get(), static_cast<int>(link), static_cast<btScalar>(low),
        static_cast<btScalar>(high)));
    for (std::size_t k = drives_.size() - 2; k < drives_.size(); ++k) {
      world_.addMultiBodyConstraint(drives_[k].get());
      drives_[k]->finalizeMultiDof();
    }
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btMultiBodyConstraintSolver solver_;
  btMultiBodyDynamicsWorld world_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::unique_ptr<btMultiBody> body_;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
  std::vector<std::unique_ptr<btMultiBodyConstraint>> drives_;
  std::array<btMultiBodyJointMotor*, kLinks> motors_{};
  Pose palm_;  ///< in the first frame
  std::array<DigitFreedoms, kDigitCount> start_{};
};

/// One hand, with what it does where physics gives up.
class PhysicsHand {
 public:
  explicit PhysicsHand(const SolverContext& context)
      : context_(context), obstacle_(make_obstacle(*context.object, context.placement)) {}

  CorrectedHand update(const HandPose& tracked, const Object& object, std::int64_t time_ns) {
    const double seconds = 1e-9 * static_cast<double>(time_ns - last_ns_);
    last_ns_ = time_ns;
    if (bodies_ && !(seconds > 0.0 && seconds < kPause_s)) bodies_.reset();
    if (is_ghost_ && is_clear(tracked, object)) is_ghost_ = false;
    if (bodies_) {
      bodies_->chase(last_, tracked, std::max(seconds, kFrameMin_s));
      const Pose palm = bodies_->palm();
      const double away = (palm.position - tracked[Joint::palm].position).norm();
      is_ghost_ = !(away < kGhostDistance_m);
      if (is_ghost_) bodies_.reset();
    } else if (obstacle_ && !is_ghost_) {
      // A hand that is found inside starts where it is out.
      WristOffset out(context_.flesh, context_.hand_scale);
      bodies_ = std::make_unique<HandBodies>(out.update(tracked, object), *context_.flesh,
                                             context_.hand_scale, *obstacle_);
    }
    last_ = tracked;
    CorrectedHand hand;
    hand.pose = bodies_ ? bodies_->pose_of(tracked) : tracked;
    hand.status = bodies_ ? HandStatus::corrected : HandStatus::free;
    return hand;
  }

 private:
  /// Whether no joint is within a thin finger's reach of the solid.
  [[nodiscard]] bool is_clear(const HandPose& hand, const Object& object) const {
    constexpr double kClear_m = 0.006;
    return std::all_of(hand.joints.begin(), hand.joints.end(), [&](const Pose& joint) {
      SurfaceHint hint;
      const auto nearest = object.closest_point(joint.position, 1.0, hint);
      return !nearest || nearest->signed_distance > kClear_m * context_.hand_scale;
    });
  }

  SolverContext context_;
  std::unique_ptr<Obstacle> obstacle_;
  std::unique_ptr<HandBodies> bodies_;  ///< none while the hand is drawn as tracked
  bool is_ghost_ = false;               ///< left behind too far, and not yet clear of the object
  HandPose last_;
  std::int64_t last_ns_ = 0;
};

}  // namespace

ComparedMethod physics_method() {
  return {"physics",
          [](const SolverContext& context) -> HandSolver {
            const auto hand = std::make_shared<PhysicsHand>(context);
            return [hand](const HandPose& tracked, const Object& object, std::int64_t time_ns) {
              return hand->update(tracked, object, time_ns);
            };
          },
          false};
}

}  // namespace nade::cli
