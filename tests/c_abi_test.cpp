#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "nade.h"
#include "nade/corrector.h"
#include "nade/flatten_skin.h"
#include "nade/flesh.h"
#include "nade/mesh.h"
#include "nade/scene.h"
#include "nade/solids.h"
#include "support/allocation_counter.h"
#include "support/meshes.h"
#include "support/pressed_hand.h"
#include "support/random.h"
#include "toy_hand.h"

namespace nade {
namespace {

using test::kFrame_ns;

constexpr double kMicrometre = 1e-6;
using Joints = std::array<nade_joint, NADE_JOINT_COUNT>;

/// Destroys what it holds.
template <class Handle, nade_status (*kDestroy)(Handle*)>
class Held {
 public:
  Held() = default;
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  ~Held() { EXPECT_EQ(kDestroy(handle_), NADE_OK) << nade_last_error(); }
  operator Handle*() const { return handle_; }  // NOLINT(google-explicit-constructor)
  Handle** put() { return &handle_; }
  Handle* release() { return std::exchange(handle_, nullptr); }

 private:
  Handle* handle_ = nullptr;
};
using CSurface = Held<nade_surface, nade_surface_destroy>;
using CScene = Held<nade_scene, nade_scene_destroy>;
using CFlesh = Held<nade_flesh, nade_flesh_destroy>;
using CSkin = Held<nade_skin, nade_skin_destroy>;
using CCorrector = Held<nade_corrector, nade_corrector_destroy>;

#define NADE_EXPECT_OK(call) EXPECT_EQ(call, NADE_OK) << nade_last_error()
#define NADE_ASSERT_OK(call) ASSERT_EQ(call, NADE_OK) << nade_last_error()

template <class Struct>
Struct sized() {
  Struct value{};
  value.size = sizeof value;
  return value;
}

nade_side c_side(Handedness side) { return side == Handedness::left ? NADE_LEFT : NADE_RIGHT; }

Joints c_joints(const HandPose& hand) {
  Joints joints{};
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Pose& pose = hand.joints[i];
    for (int k = 0; k < 4; ++k) {
      joints[i].rotation[k] = static_cast<float>(pose.rotation.coeffs()[k]);
    }
    for (int k = 0; k < 3; ++k) joints[i].position[k] = static_cast<float>(pose.position[k]);
    joints[i].radius = static_cast<float>(hand.radius[i]);
  }
  return joints;
}

/// The same hand as the C interface has it: rounded to floats.
HandPose rounded(const HandPose& hand) {
  const Joints joints = c_joints(hand);
  HandPose result = hand;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Eigen::Map<const Eigen::Vector4f> rotation(joints[i].rotation);
    const Eigen::Map<const Eigen::Vector3f> position(joints[i].position);
    result.joints[i].rotation.coeffs() = rotation.cast<double>().normalized();
    result.joints[i].position = position.cast<double>();
  }
  return result;
}

nade_placement at(float x, float y, float z) { return {{0, 0, 0, 1}, {x, y, z}, 1.0F}; }

double largest_difference(const HandPose& hand, const nade_joint* joints) {
  double largest = 0.0;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Vec3 position(joints[i].position[0], joints[i].position[1], joints[i].position[2]);
    largest = std::max(largest, (hand.joints[i].position - position).norm());
  }
  return largest;
}

/// A hand that comes down and strokes; each of its joints trembles by `noise_m`. What floats hold.
class Stroke {
 public:
  explicit Stroke(Handedness side, double noise_m = 0.0005)
      : hand_(test::generic_size_hand(side)), noise_m_(noise_m) {}

  HandPose frame(int number) {
    const double time_s = 1e-9 * kFrame_ns * number;
    const double depth_m = -0.08 + 0.1 * std::min(1.0, time_s);
    const double along_m = 0.05 * std::sin(3.0 * time_s);
    const Vec3 noise = 2.0 * noise_m_ * random_.direction();
    HandPose hand = test::pressed_hand(depth_m, 0.0, Vec3(0.0, 0.0, along_m) + noise, hand_);
    for (Pose& joint : hand.joints) joint.position += noise_m_ * random_.direction();
    hand.side = hand_.side;
    return rounded(hand);
  }

 private:
  HandPose hand_;
  double noise_m_;
  test::Random random_;
};

/// A hand with each corrector, asked frame by frame.
using Ask = std::function<const CorrectedHand&(const HandPose&, std::int64_t)>;
using AskC = std::function<nade_status(const nade_joint*, std::int64_t, nade_result*)>;

/// The largest difference of a drawn joint, metres.
double largest_difference(Stroke stroke, const Ask& ask, const AskC& ask_c) {
  double largest = 0.0;
  int corrected = 0;
  for (int i = 0; i < 270; ++i) {
    const HandPose tracked = stroke.frame(i);
    const CorrectedHand& hand = ask(tracked, i * kFrame_ns);
    auto result = sized<nade_result>();
    NADE_EXPECT_OK(ask_c(c_joints(tracked).data(), i * kFrame_ns, &result));
    EXPECT_EQ(result.status, static_cast<nade_hand_status>(hand.status)) << "frame " << i;
    EXPECT_EQ(result.contact_count, hand.skin_contact_count) << "frame " << i;
    for (std::size_t k = 0; k < hand.skin_contact_count; ++k) {
      EXPECT_EQ(result.contacts[k].object, hand.skin_contacts[k].object);
      EXPECT_EQ(result.contacts[k].bone, static_cast<std::int32_t>(hand.skin_contacts[k].bone));
      EXPECT_NEAR(static_cast<double>(result.contacts[k].depth_m), hand.skin_contacts[k].depth_m,
                  kMicrometre);
    }
    largest = std::max(largest, largest_difference(hand.pose, result.joints));
    if (hand.status == HandStatus::corrected) ++corrected;
  }
  EXPECT_GT(corrected, 100);
  return largest;
}

double largest_difference(Handedness side, Method method, const Surface& surface,
                          const nade_surface* c_surface, float y, double noise_m = 0.0005) {
  CorrectorOptions options;
  options.method = method;
  HandCorrector corrector(options);
  auto c_options = sized<nade_corrector_options>();
  NADE_EXPECT_OK(nade_corrector_options_init(&c_options));
  c_options.method = static_cast<nade_method>(method);
  CCorrector c_corrector;
  NADE_EXPECT_OK(nade_corrector_create(&c_options, c_corrector.put()));
  const Object object(surface, {{{0.0, static_cast<double>(y), 0.0}, Quat::Identity()}, 1.0}, 3);
  const nade_placement placement = at(0, y, 0);
  return largest_difference(
      Stroke(side, noise_m),
      [&](const HandPose& tracked, std::int64_t time_ns) -> const CorrectedHand& {
        return corrector.update(tracked, object, time_ns);
      },
      [&](const nade_joint* joints, std::int64_t time_ns, nade_result* result) {
        return nade_corrector_update(c_corrector, c_side(side), joints, c_surface, &placement, 3,
                                     time_ns, result);
      });
}

void make_c_mesh(const TriangleSoup& soup, nade_surface** surface) {
  auto mesh = sized<nade_mesh>();
  mesh.vertex_count = static_cast<std::uint32_t>(soup.vertices.size());
  mesh.triangle_count = static_cast<std::uint32_t>(soup.triangles.size());
  mesh.vertices = soup.vertices.data()->data();
  mesh.triangles = soup.triangles.data()->data();
  auto report = sized<nade_mesh_report>();
  NADE_ASSERT_OK(nade_surface_create_mesh(&mesh, &report, surface));
  EXPECT_EQ(report.triangles_used, soup.triangles.size());
  EXPECT_EQ(report.solid, NADE_SOLID_CLOSED);
}

TEST(CAbi, DrawsTheHandsOfTheClasses) {
  const PlaneSurface plane;
  const SphereSurface ball(0.15);
  const TriangleSoup soup = test::icosphere(0.15F, 4);
  const auto mesh = MeshSurface::build(soup, "ball");
  ASSERT_TRUE(mesh);
  CSurface c_plane;
  CSurface c_ball;
  CSurface c_mesh;
  NADE_ASSERT_OK(nade_surface_create_plane(c_plane.put()));
  NADE_ASSERT_OK(nade_surface_create_sphere(0.15, c_ball.put()));
  make_c_mesh(soup, c_mesh.put());
  double largest = 0.0;
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    for (const Method method : {Method::paper, Method::nade}) {
      SCOPED_TRACE(std::string(name_of(side)) + " " + std::string(name_of(method)));
      const double on_plane = largest_difference(side, method, plane, c_plane, 0.0F);
      const double on_ball = largest_difference(side, method, ball, c_ball, -0.15F);
      const double on_mesh = largest_difference(side, method, *mesh.value(), c_mesh, -0.15F);
      EXPECT_LT(on_plane, kMicrometre);
      EXPECT_LT(on_ball, kMicrometre);
      EXPECT_LT(on_mesh, kMicrometre);
      largest = std::max({largest, on_plane, on_ball, on_mesh});
    }
  }
  RecordProperty("largest_difference_um", std::to_string(1e6 * largest));
}

TEST(CAbi, DrawsTheHandsOfTheClassesInAScene) {
  const SphereSurface ball(0.05);
  const PlaneSurface plane;
  CSurface c_ball;
  CSurface c_plane;
  NADE_ASSERT_OK(nade_surface_create_sphere(0.05, c_ball.put()));
  NADE_ASSERT_OK(nade_surface_create_plane(c_plane.put()));
  SettleOptions soft;
  soft.softness_m = 0.007;
  soft.friction.coefficient = 0.5;
  auto c_soft = sized<nade_feel>();
  NADE_ASSERT_OK(nade_feel_init(&c_soft));
  c_soft.softness_m = 0.007;
  c_soft.friction = 0.5;
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    Scene scene;
    CScene c_scene;
    NADE_ASSERT_OK(nade_scene_create(c_scene.put()));
    scene.add(1, plane, {}, soft);
    NADE_ASSERT_OK(nade_scene_add(c_scene, 1, c_plane, nullptr, &c_soft));
    scene.add(2, ball, {{{0.0, 0.0, 0.0}, Quat::Identity()}, 1.0});
    NADE_ASSERT_OK(nade_scene_add(c_scene, 2, c_ball, nullptr, nullptr));
    HandCorrector corrector;
    CCorrector c_corrector;
    NADE_ASSERT_OK(nade_corrector_create(nullptr, c_corrector.put()));
    const double largest = largest_difference(
        Stroke(side),
        [&](const HandPose& tracked, std::int64_t time_ns) -> const CorrectedHand& {
          const double x = 0x1p-13 * static_cast<double>(time_ns / kFrame_ns);
          scene.place(2, {{{x, 0.0, -0.125}, Quat::Identity()}, 1.0});
          return corrector.update(tracked, scene, time_ns);
        },
        [&](const nade_joint* joints, std::int64_t time_ns, nade_result* result) {
          const float x = 0x1p-13F * static_cast<float>(time_ns / kFrame_ns);
          const nade_placement placement = at(x, 0.0F, -0.125F);
          NADE_EXPECT_OK(nade_scene_place(c_scene, 2, &placement));
          return nade_corrector_update_scene(c_corrector, c_side(side), joints, c_scene, time_ns,
                                             result);
        });
    EXPECT_LT(largest, kMicrometre);
    RecordProperty("largest_difference_um_" + std::string(name_of(side)),
                   std::to_string(1e6 * largest));
  }
}

/// What it points to is the mesh's and `bind`.
nade_hand_mesh c_hand_mesh(const HandMesh& mesh, const Joints& bind) {
  auto c_mesh = sized<nade_hand_mesh>();
  c_mesh.side = c_side(mesh.side);
  c_mesh.vertex_count = static_cast<std::uint32_t>(mesh.vertices.size());
  c_mesh.triangle_count = static_cast<std::uint32_t>(mesh.triangles.size());
  c_mesh.vertices = mesh.vertices.data()->data();
  c_mesh.normals = mesh.normals.data()->data();
  c_mesh.triangles = mesh.triangles.data()->data();
  c_mesh.bones = mesh.bones.data()->data();
  c_mesh.weights = mesh.weights.data()->data();
  c_mesh.bind = bind.data();
  return c_mesh;
}

TEST(CAbi, FlattensTheSkinOfTheClasses) {
  const HandMesh mesh = test::toy_mesh(Handedness::right);
  const Joints bind = c_joints(mesh.bind);
  const nade_hand_mesh c_mesh = c_hand_mesh(mesh, bind);
  CSkin skin;
  NADE_ASSERT_OK(nade_skin_create(&c_mesh, skin.put()));
  CSurface c_ball;
  NADE_ASSERT_OK(nade_surface_create_sphere(0.15, c_ball.put()));
  const nade_placement below = at(0, -0.15F, 0);
  CScene c_scene;
  NADE_ASSERT_OK(nade_scene_create(c_scene.put()));
  NADE_ASSERT_OK(nade_scene_add(c_scene, 1, c_ball, &below, nullptr));
  const SphereSurface ball(0.15);
  const Object object(ball, {{{0.0, -0.15, 0.0}, Quat::Identity()}, 1.0});
  SkinFlattener flattener(mesh);
  HandCorrector corrector;
  Stroke stroke(Handedness::right);
  const std::size_t count = mesh.vertices.size();
  std::vector<Eigen::Vector3f> expected(count);
  std::vector<Eigen::Vector3f> normals(count);
  std::vector<Eigen::Vector3f> posed(count);
  std::vector<Eigen::Vector3f> c_normals(count);
  std::size_t moved = 0;
  for (int i = 0; i < 150; ++i) {
    const HandPose drawn = rounded(corrector.update(stroke.frame(i), object, i * kFrame_ns).pose);
    const double scale = hand_scale(mesh, drawn);
    pose_skin(mesh, drawn, scale, expected, normals);
    flattener.flatten(object, drawn, scale, 0.0, expected, expected, normals);
    const Joints joints = c_joints(drawn);
    float* const c_vertices = posed.data()->data();
    NADE_ASSERT_OK(
        nade_skin_pose(skin, joints.data(), scale, c_vertices, c_normals.data()->data(), count));
    const std::vector<Eigen::Vector3f> before = posed;
    if (i % 2 == 0) {
      NADE_ASSERT_OK(nade_skin_flatten(skin, joints.data(), scale, c_ball, &below, 0.0, c_vertices,
                                       c_normals.data()->data(), count));
    } else {
      NADE_ASSERT_OK(nade_skin_flatten_scene(skin, joints.data(), scale, c_scene, 0.0, c_vertices,
                                             c_normals.data()->data(), count));
    }
    for (std::size_t k = 0; k < count; ++k) {
      ASSERT_LT((posed[k] - expected[k]).norm(), 2e-6F) << "frame " << i;
      ASSERT_LT((c_normals[k] - normals[k]).norm(), 1e-3F) << "frame " << i;
      if (posed[k] != before[k]) ++moved;
    }
  }
  EXPECT_GT(moved, 200U);
  const Joints joints = c_joints(mesh.bind);
  EXPECT_EQ(test::allocations_of([&] {
              (void)nade_skin_pose(skin, joints.data(), 1.0, posed.data()->data(), nullptr, count);
              (void)nade_skin_flatten(skin, joints.data(), 1.0, c_ball, &below, 0.0,
                                      posed.data()->data(), nullptr, count);
              (void)nade_skin_flatten_scene(skin, joints.data(), 1.0, c_scene, 0.0,
                                            posed.data()->data(), nullptr, count);
            }),
            0U);
}

TEST(CAbi, MeasuresTheFleshOfAMesh) {
  const HandMesh mesh = test::toy_mesh(Handedness::right);
  const Joints bind = c_joints(mesh.bind);
  const nade_hand_mesh c_mesh = c_hand_mesh(mesh, bind);
  CFlesh flesh;
  NADE_ASSERT_OK(nade_flesh_create(&c_mesh, flesh.put()));
  auto c_options = sized<nade_corrector_options>();
  NADE_ASSERT_OK(nade_corrector_options_init(&c_options));
  c_options.right_flesh = flesh;
  CCorrector c_corrector;
  NADE_ASSERT_OK(nade_corrector_create(&c_options, c_corrector.put()));
  NADE_EXPECT_OK(nade_flesh_destroy(flesh.release()));  // the corrector keeps it
  CSurface c_plane;
  NADE_ASSERT_OK(nade_surface_create_plane(c_plane.put()));

  CorrectorOptions options;
  options.flesh[index_of(Handedness::right)] =
      std::make_shared<const HandFlesh>(measure_flesh(mesh));
  options.skin = measure_skin_depths(mesh);
  options.skin_hand_length_m = hand_length(mesh.bind);
  HandCorrector corrector(options);
  EXPECT_LT(largest_difference(
                Stroke(Handedness::right),
                [&](const HandPose& tracked, std::int64_t time_ns) -> const CorrectedHand& {
                  return corrector.update(tracked, test::plane(), time_ns);
                },
                [&](const nade_joint* joints, std::int64_t time_ns, nade_result* result) {
                  return nade_corrector_update(c_corrector, NADE_RIGHT, joints, c_plane, nullptr, 0,
                                               time_ns, result);
                }),
            kMicrometre);

  EXPECT_EQ(nade_corrector_options_check(&c_options), NADE_ERROR_HANDLE);
  CFlesh right;
  NADE_ASSERT_OK(nade_flesh_create(&c_mesh, right.put()));
  c_options.right_flesh = right;
  NADE_EXPECT_OK(nade_corrector_options_check(&c_options));
  c_options.left_flesh = right;
  EXPECT_EQ(nade_corrector_options_check(&c_options), NADE_ERROR_ARGUMENT);
}

/// Points about the origin, asked of a solid both ways.
void expect_same_points(const Surface& surface, const nade_surface* c_surface) {
  test::Random random;
  for (int i = 0; i < 200; ++i) {
    const Vec3 query = random.point(Vec3::Constant(-0.3), Vec3::Constant(0.3));
    SurfaceHint hint;
    const auto expected = surface.closest_point(query, 1.0, hint);
    nade_surface_point point{};
    std::int32_t found = 0;
    NADE_ASSERT_OK(
        nade_surface_closest_point(c_surface, nullptr, query.data(), 1.0, &point, &found));
    ASSERT_TRUE(expected.has_value());
    ASSERT_EQ(found, 1);
    EXPECT_NEAR(point.signed_distance, expected->signed_distance, 1e-7);
  }
}

TEST(CAbi, MakesEachShape) {
  const std::array<double, 3> half{0.1, 0.05, 0.2};
  const Vec3 half_m(half.data());
  const auto expect = [](const Surface& surface, nade_status status, nade_surface* made) {
    NADE_ASSERT_OK(status);
    expect_same_points(surface, made);
    NADE_EXPECT_OK(nade_surface_destroy(made));
  };
  nade_surface* made = nullptr;
  nade_status status = nade_surface_create_box(half.data(), 0.01, &made);
  expect(BoxSurface(half_m, 0.01), status, made);
  status = nade_surface_create_ellipsoid(half.data(), &made);
  expect(EllipsoidSurface(half_m), status, made);
  status = nade_surface_create_cylinder(0.1, 0.05, 0.01, &made);
  expect(CylinderSurface(0.1, 0.05, 0.01), status, made);
  status = nade_surface_create_capsule(0.2, 0.05, &made);
  expect(capsule_surface(0.2, 0.05), status, made);
  const std::array<float, 8> outline{-0.1F, -0.1F, 0.1F, -0.1F, 0.1F, 0.1F, -0.1F, 0.1F};
  const std::array<Eigen::Vector2d, 4> corners{
      Eigen::Vector2d(-0.1, -0.1), {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}};
  status = nade_surface_create_plate(outline.data(), 4, 0.02, &made);
  expect(PlateSurface(corners, 0.02), status, made);

  const TriangleSoup box = test::box_mesh({0.1F, 0.05F, 0.2F});
  const auto hull = convex_hull(box.vertices);
  ASSERT_TRUE(hull);
  const auto hull_surface = MeshSurface::build(hull.value(), "hull");
  ASSERT_TRUE(hull_surface);
  status = nade_surface_create_hull(box.vertices.data()->data(), box.vertices.size(), &made);
  expect(*hull_surface.value(), status, made);

  const std::array<float, 6> heights{0.0F, 0.02F, 0.0F, 0.01F, 0.03F, 0.0F};
  const auto field = height_field(heights, 3, 0.25);
  ASSERT_TRUE(field);
  const auto field_surface = MeshSurface::build(field.value(), "field");
  ASSERT_TRUE(field_surface);
  status = nade_surface_create_height_field(heights.data(), 3, 2, 0.25, &made);
  expect(*field_surface.value(), status, made);
}

TEST(CAbi, ScalesAMeshAlongItsAxesAlsoWhereItIsRefitted) {
  const TriangleSoup cube = test::box_mesh({0.1F, 0.1F, 0.1F});
  auto mesh = sized<nade_mesh>();
  mesh.vertex_count = static_cast<std::uint32_t>(cube.vertices.size());
  mesh.triangle_count = static_cast<std::uint32_t>(cube.triangles.size());
  mesh.vertices = cube.vertices.data()->data();
  mesh.triangles = cube.triangles.data()->data();
  mesh.scale[0] = -1.0F;
  mesh.scale[1] = 0.5F;
  mesh.scale[2] = 2.0F;
  CSurface surface;
  NADE_ASSERT_OK(nade_surface_create_mesh(&mesh, nullptr, surface.put()));
  expect_same_points(BoxSurface({0.1, 0.05, 0.2}), surface);
  std::vector<Eigen::Vector3f> larger = cube.vertices;
  for (Eigen::Vector3f& vertex : larger) vertex *= 1.5F;
  EXPECT_EQ(test::allocations_of([&] {
              NADE_EXPECT_OK(nade_surface_refit(surface, larger.data()->data(), larger.size()));
            }),
            0U);
  expect_same_points(BoxSurface({0.15, 0.075, 0.3}), surface);
}

TEST(CAbi, GroupsKeepTheirMembers) {
  CSurface ball;
  NADE_ASSERT_OK(nade_surface_create_sphere(0.1, ball.put()));
  const std::array<nade_group_member, 2> members{nade_group_member{ball, at(1, 0, 0)},
                                                 nade_group_member{ball, at(-1, 0, 0)}};
  CSurface group;
  NADE_ASSERT_OK(nade_surface_create_group(members.data(), members.size(), group.put()));
  NADE_EXPECT_OK(nade_surface_destroy(ball.release()));
  const nade_placement up = at(0, 1, 0);
  NADE_EXPECT_OK(nade_surface_place_member(group, 1, &up));
  EXPECT_EQ(nade_surface_place_member(group, 2, &up), NADE_ERROR_ARGUMENT);
  const std::array<double, 3> query{0.0, 1.5, 0.0};
  nade_surface_point point{};
  std::int32_t found = 0;
  NADE_ASSERT_OK(nade_surface_closest_point(group, nullptr, query.data(), 2.0, &point, &found));
  EXPECT_NEAR(point.signed_distance, 0.4, 1e-6);
  NADE_ASSERT_OK(nade_surface_closest_point(group, nullptr, query.data(), 0.1, &point, &found));
  EXPECT_EQ(found, 0);
  EXPECT_NEAR(point.signed_distance, 0.4, 1e-6);
}

/// A ball of the program's own.
struct OwnBall {
  double radius_m = 0.15;
  std::uint64_t shape = 0;
  bool tells_nonsense = false;
  int released = 0;
  int rays = 0;

  static std::int32_t closest_point(void* user, const double query[3], double max_distance,
                                    std::uint32_t* /*hint*/, nade_surface_point* point) {
    const OwnBall& ball = *static_cast<OwnBall*>(user);
    const Vec3 from(query[0], query[1], query[2]);
    const Vec3 normal = from.norm() > 0.0 ? Vec3(from.normalized()) : Vec3::UnitY();
    const double distance = from.norm() - ball.radius_m;
    if (std::abs(distance) > max_distance) return 0;
    const double nonsense = ball.tells_nonsense ? std::nan("") : 1.0;
    for (int i = 0; i < 3; ++i) {
      point->normal[i] = nonsense * normal[i];
      point->point[i] = ball.radius_m * normal[i];
    }
    point->signed_distance = distance;
    return 1;
  }
  static std::int32_t first_hit(void* user, const double origin[3], const double direction[3],
                                double max_distance, nade_ray_hit* hit) {
    OwnBall& ball = *static_cast<OwnBall*>(user);
    ++ball.rays;
    const auto found =
        SphereSurface(ball.radius_m).first_hit({Vec3(origin), Vec3(direction), max_distance});
    if (!found) return 0;
    for (int i = 0; i < 3; ++i) hit->point[i] = found->point[i];
    for (int i = 0; i < 3; ++i) hit->normal[i] = 3.0 * found->normal[i];
    hit->distance = found->distance;
    return 1;
  }
  static std::uint64_t shape_of(void* user) { return static_cast<OwnBall*>(user)->shape; }
  static std::int32_t bounds(void* user, double low[3], double high[3]) {
    const double radius = static_cast<OwnBall*>(user)->radius_m;
    for (int i = 0; i < 3; ++i) high[i] = radius;
    for (int i = 0; i < 3; ++i) low[i] = -radius;
    return 1;
  }
  static void release(void* user) { ++static_cast<OwnBall*>(user)->released; }

  nade_surface_callbacks callbacks() {
    auto result = sized<nade_surface_callbacks>();
    result.user = this;
    result.closest_point = closest_point;
    result.shape = shape_of;
    result.bounds = bounds;
    result.release = release;
    return result;
  }
};

/// Rays are found by its closest points, which method paper lives on. A last digit of an answer
/// would send a trembling hand another way.
TEST(CAbi, SurfacesOfOnesOwn) {
  OwnBall own;
  const nade_surface_callbacks callbacks = own.callbacks();
  {
    CSurface surface;
    NADE_ASSERT_OK(nade_surface_create_custom(&callbacks, surface.put()));
    for (const Method method : {Method::paper, Method::nade}) {
      EXPECT_LT(largest_difference(Handedness::right, method, test::kBall, surface, -0.15F, 0.0),
                kMicrometre);
    }
    own.tells_nonsense = true;
    const std::array<double, 3> query{0.0, 0.2, 0.0};
    nade_surface_point point{};
    std::int32_t found = 1;
    NADE_EXPECT_OK(nade_surface_closest_point(surface, nullptr, query.data(), 1, &point, &found));
    EXPECT_EQ(found, 0);
    EXPECT_EQ(own.released, 0);
  }
  EXPECT_EQ(own.released, 1);
}

TEST(CAbi, RaysOfOnesOwn) {
  OwnBall own;
  nade_surface_callbacks callbacks = own.callbacks();
  callbacks.first_hit = OwnBall::first_hit;
  CSurface surface;
  NADE_ASSERT_OK(nade_surface_create_custom(&callbacks, surface.put()));
  EXPECT_LT(largest_difference(Handedness::left, Method::paper, test::kBall, surface, -0.15F, 0.0),
            kMicrometre);
  EXPECT_GT(own.rays, 100);
}

/// As long as a scene has it; a hand rests on it while it goes.
TEST(CAbi, ASurfaceLivesWhileItIsUsed) {
  OwnBall own;
  const nade_surface_callbacks callbacks = own.callbacks();
  CScene scene;
  CCorrector corrector;
  NADE_ASSERT_OK(nade_scene_create(scene.put()));
  NADE_ASSERT_OK(nade_corrector_create(nullptr, corrector.put()));
  nade_surface* surface = nullptr;
  NADE_ASSERT_OK(nade_surface_create_custom(&callbacks, &surface));
  const nade_placement below = at(0, -0.15F, 0);
  NADE_ASSERT_OK(nade_scene_add(scene, 4, surface, &below, nullptr));
  NADE_EXPECT_OK(nade_surface_destroy(surface));
  EXPECT_EQ(nade_surface_destroy(surface), NADE_ERROR_HANDLE);
  Stroke stroke(Handedness::right);
  auto result = sized<nade_result>();
  for (int i = 0; i < 180; ++i) {
    if (i == 120) {
      EXPECT_EQ(result.status, NADE_HAND_CORRECTED);
      EXPECT_EQ(own.released, 0);
      NADE_EXPECT_OK(nade_scene_remove(scene, 4));
      EXPECT_EQ(own.released, 1);
    }
    const Joints joints = c_joints(stroke.frame(i));
    NADE_ASSERT_OK(nade_corrector_update_scene(corrector, NADE_RIGHT, joints.data(), scene,
                                               i * kFrame_ns, &result));
  }
  EXPECT_NE(result.status, NADE_HAND_CORRECTED);
}

TEST(CAbi, ACorrectorKeepsItsLastSurface) {
  OwnBall own;
  const nade_surface_callbacks callbacks = own.callbacks();
  CCorrector corrector;
  NADE_ASSERT_OK(nade_corrector_create(nullptr, corrector.put()));
  nade_surface* surface = nullptr;
  NADE_ASSERT_OK(nade_surface_create_custom(&callbacks, &surface));
  Stroke stroke(Handedness::right);
  auto result = sized<nade_result>();
  const Joints joints = c_joints(stroke.frame(0));
  NADE_ASSERT_OK(
      nade_corrector_update(corrector, NADE_RIGHT, joints.data(), surface, nullptr, 0, 0, &result));
  NADE_EXPECT_OK(nade_surface_destroy(surface));
  EXPECT_EQ(own.released, 0);
  NADE_ASSERT_OK(nade_corrector_update(corrector, NADE_RIGHT, joints.data(), nullptr, nullptr, 0,
                                       kFrame_ns, &result));
  EXPECT_EQ(own.released, 1);
}

TEST(CAbi, AnUntouchedHandIsBitForBit) {
  CCorrector corrector;
  NADE_ASSERT_OK(nade_corrector_create(nullptr, corrector.put()));
  Stroke stroke(Handedness::left);
  for (int i = 0; i < 20; ++i) {
    Joints joints = c_joints(stroke.frame(i));
    for (nade_joint& joint : joints) {
      for (float& number : joint.rotation) number *= 1.0003F;  // as rounded files have them
      joint.radius = 0.008F;
    }
    auto result = sized<nade_result>();
    NADE_ASSERT_OK(nade_corrector_update(corrector, NADE_LEFT, joints.data(), nullptr, nullptr, 0,
                                         i * kFrame_ns, &result));
    EXPECT_EQ(result.status, NADE_HAND_FREE);
    EXPECT_EQ(std::memcmp(result.joints, joints.data(), sizeof result.joints), 0);
    Joints drawn{};
    NADE_ASSERT_OK(nade_corrector_preview(corrector, NADE_LEFT, joints.data(), drawn.data()));
    EXPECT_EQ(std::memcmp(drawn.data(), joints.data(), sizeof result.joints), 0);
  }
}

TEST(CAbi, FramesDoNotAllocate) {
  CSurface ball;
  CScene scene;
  CCorrector alone;
  CCorrector in_scene;
  NADE_ASSERT_OK(nade_surface_create_sphere(0.15, ball.put()));
  NADE_ASSERT_OK(nade_scene_create(scene.put()));
  const nade_placement below = at(0, -0.15F, 0);
  NADE_ASSERT_OK(nade_scene_add(scene, 4, ball, &below, nullptr));
  NADE_ASSERT_OK(nade_corrector_create(nullptr, alone.put()));
  NADE_ASSERT_OK(nade_corrector_create(nullptr, in_scene.put()));
  auto feel = sized<nade_feel>();
  NADE_ASSERT_OK(nade_feel_init(&feel));
  Stroke stroke(Handedness::right);
  for (int i = 0; i < 120; ++i) {
    const Joints joints = c_joints(stroke.frame(i));
    auto result = sized<nade_result>();
    Joints drawn{};
    const nade_placement placement = at(0.0001F * static_cast<float>(i), -0.15F, 0);
    nade_status status = NADE_OK;
    const auto follow = [&status](nade_status next) {
      if (next != NADE_OK) status = next;
    };
    ASSERT_EQ(test::allocations_of([&] {
                follow(nade_corrector_update(alone, NADE_RIGHT, joints.data(), ball, &placement, 4,
                                             i * kFrame_ns, &result));
                follow(nade_corrector_preview(alone, NADE_RIGHT, joints.data(), drawn.data()));
                follow(nade_corrector_set_feel(alone, &feel));
                follow(nade_scene_place(scene, 4, &placement));
                follow(nade_scene_deformed(scene, 4));
                follow(nade_scene_set_feel(scene, 4, &feel));
                follow(nade_corrector_update_scene(in_scene, NADE_RIGHT, joints.data(), scene,
                                                   i * kFrame_ns, &result));
              }),
              0U);
    ASSERT_EQ(status, NADE_OK) << nade_last_error();
  }
}

TEST(CAbi, ShorterStructsHaveDefaults) {
  struct {
    nade_feel feel;
    std::uint32_t behind = 7;
  } kept;
  kept.feel.size = offsetof(nade_feel, friction);
  kept.feel.friction = -1.0;
  NADE_EXPECT_OK(nade_feel_init(&kept.feel));
  EXPECT_EQ(kept.feel.softness_depth_m, 0.02);
  EXPECT_EQ(kept.feel.friction, -1.0);  // not the library's
  auto options = sized<nade_corrector_options>();
  NADE_EXPECT_OK(nade_corrector_options_init(&options));
  options.feel = &kept.feel;
  NADE_EXPECT_OK(nade_corrector_options_check(&options));
  for (const std::uint32_t size : {0U, 4U, 6U, 13U}) {
    kept.feel.size = size;
    EXPECT_EQ(nade_feel_init(&kept.feel), NADE_ERROR_SIZE) << size;
    EXPECT_EQ(nade_corrector_options_check(&options), NADE_ERROR_SIZE) << size;
  }
  EXPECT_EQ(kept.behind, 7U);

  CCorrector corrector;
  NADE_ASSERT_OK(nade_corrector_create(nullptr, corrector.put()));
  nade_result result;
  std::memset(&result, 0x55, sizeof result);
  result.size = offsetof(nade_result, velocity_mps);
  const Joints joints = c_joints(test::pressed_hand(0.01));
  NADE_EXPECT_OK(
      nade_corrector_update(corrector, NADE_RIGHT, joints.data(), nullptr, nullptr, 0, 0, &result));
  EXPECT_EQ(std::memcmp(result.joints, joints.data(), sizeof result.joints), 0);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &result.velocity_mps[0][0], sizeof bits);
  EXPECT_EQ(bits, 0x55555555U);
  EXPECT_EQ(result.size, offsetof(nade_result, velocity_mps));
}

TEST(CAbi, LongerStructsMayHoldNothingMore) {
  struct {
    nade_corrector_options known;
    std::uint64_t added = 5;
  } options{};
  options.known.size = sizeof options;
  NADE_EXPECT_OK(nade_corrector_options_init(&options.known));
  EXPECT_EQ(options.added, 0U);
  NADE_EXPECT_OK(nade_corrector_options_check(&options.known));
  options.added = 1;
  EXPECT_EQ(nade_corrector_options_check(&options.known), NADE_ERROR_SIZE);
  options.known.size = 0xcccccccc;
  EXPECT_EQ(nade_corrector_options_check(&options.known), NADE_ERROR_SIZE);
}

TEST(CAbi, DestroyedHandlesAreTold) {
  std::vector<nade_surface*> destroyed;
  for (int i = 0; i < 64; ++i) {
    nade_surface* surface = nullptr;
    NADE_ASSERT_OK(nade_surface_create_plane(&surface));
    NADE_ASSERT_OK(nade_surface_destroy(surface));
    destroyed.push_back(surface);
  }
  for (nade_surface* const surface : destroyed) {
    EXPECT_EQ(nade_surface_destroy(surface), NADE_ERROR_HANDLE);
  }
  CScene scene;
  NADE_ASSERT_OK(nade_scene_create(scene.put()));
  EXPECT_EQ(nade_scene_add(scene, 1, destroyed[0], nullptr, nullptr), NADE_ERROR_HANDLE);
  EXPECT_EQ(nade_surface_destroy(reinterpret_cast<nade_surface*>(static_cast<nade_scene*>(scene))),
            NADE_ERROR_HANDLE);
  std::size_t size = 9;
  NADE_EXPECT_OK(nade_scene_size(scene, &size));
  EXPECT_EQ(size, 0U);
}

TEST(CAbi, TheRestingHandIsOneThatCanBeUsed) {
  for (const nade_side side : {NADE_LEFT, NADE_RIGHT}) {
    Joints joints{};
    NADE_ASSERT_OK(nade_rest_hand(side, joints.data()));
    EXPECT_NEAR(joints[NADE_JOINT_PALM].position[1], 0.0F, 1e-6F);
    EXPECT_LT(joints[NADE_JOINT_MIDDLE_TIP].position[2], -0.1F);
    EXPECT_GT(joints[NADE_JOINT_WRIST].position[2], 0.04F);
    const float thumb = joints[NADE_JOINT_THUMB_TIP].position[0];
    EXPECT_GT(side == NADE_LEFT ? thumb : -thumb, 0.02F);
  }
}

}  // namespace
}  // namespace nade
