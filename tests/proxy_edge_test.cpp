#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "nade/corrector.h"
#include "nade/mesh.h"
#include "support/hand_checks.h"
#include "support/meshes.h"
#include "support/pressed_hand.h"

// Hands over the edge of a box, and in an inside corner.

namespace nade {
namespace {

using test::kFrame_ns;
using test::least_room;
using test::pressed_hand;
using test::settling;

constexpr float kSize_m = 0.4F;

/// Its top at y = 0, with its middle at `middle`; its edges are rounded over `bevel_m`, if at all.
std::unique_ptr<MeshSurface> box_at(const Vec3& middle, float bevel_m = 0.0F) {
  const test::Vec3f half_size = test::Vec3f::Constant(0.5F * kSize_m);
  const TriangleSoup box =
      bevel_m > 0.0F ? test::rounded_box_mesh(half_size, bevel_m) : test::box_mesh(half_size);
  return MeshSurface::build(test::shifted(box, middle.cast<float>()), "box").value();
}

/// From 0 to 1, starting and ending at rest.
double eased(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// The surface point nearest to a palm that comes down beside an edge is the edge, and the way from
/// it leans: the hand was driven aside by nearly as much as it was pressed down.
TEST(ProxyEdge, AHandPressedDownOverAnEdgeIsNotDrivenAside) {
  const auto box = box_at({0.2, -0.2, 0.0});
  const Object object(*box);
  for (const double beside_m : {-0.005, 0.0, 0.01}) {  // the palm's middle from the edge
    HandCorrector corrector(settling());
    HandPose tracked, drawn;
    for (int i = 0; i < 200; ++i) {
      tracked = pressed_hand(-0.08 + 0.1 * eased(i / 90.0), 0.0, {beside_m, 0.0, 0.0});
      drawn = corrector.update(tracked, object, i * kFrame_ns).pose;
    }
    const Vec3 shift = drawn[Joint::palm].position - tracked[Joint::palm].position;
    EXPECT_LT(std::hypot(shift.x(), shift.z()), 0.005) << "palm " << beside_m << " m from the edge";
    EXPECT_TRUE(test::rests_on(object, drawn));
  }
}

/// Fingers first over the edge, until only the heel is on it, and back. Gives how far from where it
/// was the palm is then.
double away_after_a_way_over(const Object& box, double depth_m) {
  HandCorrector corrector(settling());
  std::vector<Vec3> palms;
  for (int i = 0; i < 600; ++i) {
    const double down = eased(i / 90.0);
    const double out = eased((i - 120) / 180.0) - eased((i - 300) / 180.0);
    const HandPose tracked =
        pressed_hand(-0.08 + (0.08 + depth_m) * down, 0.0, {0.0, 0.0, 0.06 - 0.16 * out});
    palms.push_back(corrector.update(tracked, box, i * kFrame_ns).pose[Joint::palm].position);
  }
  return (palms.back() - palms[119]).norm();
}

/// What was depth on the top was astray on the side: a hand that came back stayed there.
TEST(ProxyEdge, AHandThatGoesOverAnEdgeAndBackIsWhereItWas) {
  const auto box = box_at({0.0, -0.2, 0.17});
  for (const double depth_m : {0.03, 0.05}) {
    EXPECT_LT(away_after_a_way_over(Object(*box), depth_m), 0.025) << depth_m << " m deep";
  }
}

/// A rounded edge was none: the hand was lost on the box's side, 11 to 48 mm from where it was.
TEST(ProxyEdge, ABevelledEdgeIsAnEdge) {
  for (const float bevel_m : {0.0005F, 0.002F, 0.005F, 0.01F}) {
    const auto box = box_at({0.0, -0.2, 0.17}, bevel_m);
    EXPECT_LT(away_after_a_way_over(Object(*box), 0.05), 0.025) << bevel_m << " m";
  }
}

/// A floor at y = 0 that ends at z = 0 with a wall, at so much inside of the corner.
std::unique_ptr<MeshSurface> floor_and_wall(double corner_rad) {
  constexpr float kWide_m = 1.0F;
  const auto lean_m = static_cast<float>(0.4 / std::tan(corner_rad));
  const std::vector<test::Vec3f> profile{{0.0F, 0.0F, 0.0F},  {0.0F, 0.0F, 1.0F},
                                         {0.0F, -0.2F, 1.0F}, {0.0F, -0.2F, -0.2F},
                                         {0.0F, 0.4F, -0.2F}, {0.0F, 0.4F, lean_m}};
  TriangleSoup soup;
  const auto corners = static_cast<std::uint32_t>(profile.size());
  for (const float side : {-kWide_m, kWide_m}) {
    for (const test::Vec3f& corner : profile)
      soup.vertices.push_back(corner + side * test::Vec3f::UnitX());
  }
  for (std::uint32_t i = 0; i < corners; ++i) {
    const std::uint32_t next = (i + 1) % corners;
    soup.triangles.push_back({i, next, next + corners});
    soup.triangles.push_back({i, next + corners, i + corners});
    if (i == 0 || next == 0) continue;
    soup.triangles.push_back({0, next, i});
    soup.triangles.push_back({corners, i + corners, next + corners});
  }
  return MeshSurface::build(soup, "corner").value();
}

/// Turned, so that the hand points so far aside of the wall.
Object turned(const MeshSurface& surface, double heading_rad) {
  return Object(surface,
                {{Vec3::Zero(), Quat(Eigen::AngleAxisd(heading_rad, Vec3::UnitY()))}, 1.0});
}

/// Down onto the floor and straight on into the wall, fingers first. Gives the signed distance of
/// what skin is deepest on the way.
double lowest_on_the_way_in(const Object& corner, double speed_mps) {
  HandCorrector corrector(settling());
  double lowest_m = std::numeric_limits<double>::infinity();
  const int frames = 90 + static_cast<int>(90.0 * 0.3 / speed_mps);
  for (int i = 0; i < frames; ++i) {
    const Vec3 from_wall(0.0, 0.0, 0.3 - speed_mps * std::max(0, i - 90) / 90.0);
    const HandPose tracked = pressed_hand(-0.08 + 0.1 * eased(i / 90.0), 0.0,
                                          corner.placement().pose.rotation * from_wall);
    const HandPose& drawn = corrector.update(tracked, corner, i * kFrame_ns).pose;
    lowest_m = std::min(lowest_m, least_room(drawn, corner));
  }
  return lowest_m;
}

/// The way out of the object turned slowly from one side to the other, and kept out of neither:
/// fingers that slid on along the floor went into the wall by up to 13 mm.
TEST(ProxyEdge, FingersThatSlideOnIntoAnInsideCornerStayOutOfBothSides) {
  for (const double corner : {60.0, 90.0}) {
    const auto surface = floor_and_wall(test::rad(corner));
    for (const double heading : {0.0, 20.0}) {
      const Object object = turned(*surface, test::rad(heading));
      for (const double speed_mps : {0.1, 0.3, 0.8}) {
        EXPECT_GT(lowest_on_the_way_in(object, speed_mps), -0.005)
            << corner << " degrees, heading " << heading << ", " << speed_mps << " m/s";
      }
    }
  }
}

/// A floor at y = 0 and on it walls: thin, their fronts through the origin, facing so.
std::unique_ptr<MeshSurface> floor_and_thin_walls(const std::vector<test::Vec3f>& facing,
                                                  float thick_m) {
  TriangleSoup soup = test::shifted(test::box_mesh({1.0F, 0.1F, 1.0F}), {0.0F, -0.1F, 0.0F});
  for (const test::Vec3f& normal : facing) {
    const test::Vec3f along = test::Vec3f::UnitY().cross(normal).cwiseAbs();
    const test::Vec3f half_size = along + 0.5F * thick_m * normal + 0.2F * test::Vec3f::UnitY();
    const test::Vec3f middle = 0.15F * test::Vec3f::UnitY() - 0.5F * thick_m * normal;
    soup = test::joined(soup, test::shifted(test::box_mesh(half_size), middle));
  }
  return MeshSurface::build(soup, "walls").value();
}

/// How far the skin of a hand that is farthest beyond such a wall is.
double farthest_beyond(const std::vector<test::Vec3f>& facing, const HandPose& hand) {
  double farthest_m = -std::numeric_limits<double>::infinity();
  for (const FleshPoint& point : generic_flesh(hand.side).skin) {
    const Vec3 skin = position_of(point, hand, 1.0);
    for (const test::Vec3f& normal : facing) {
      farthest_m = std::max(farthest_m, -normal.cast<double>().dot(skin));
    }
  }
  return farthest_m;
}

/// Down onto the floor and straight through such walls, for 0.4 m, with the middle finger ahead or
/// turned from there. Gives how far beyond any of them skin is on the way.
double farthest_on_the_way_through(const std::vector<test::Vec3f>& facing, float thick_m,
                                   const Vec3& from, double heading_rad, double speed_mps) {
  const auto surface = floor_and_thin_walls(facing, thick_m);
  const Object object(*surface);
  const Quat turn(Eigen::AngleAxisd(heading_rad, Vec3::UnitY()));
  HandCorrector corrector(settling());
  double farthest_m = -std::numeric_limits<double>::infinity();
  const int frames = 60 + static_cast<int>(90.0 * 0.4 / speed_mps);
  for (int i = 0; i < frames; ++i) {
    const Vec3 gone = speed_mps * std::max(0, i - 60) / 90.0 * from.normalized();
    const HandPose down = pressed_hand(-0.08 + 0.085 * eased(i / 60.0));
    const HandPose tracked = moved(down, {from - gone, turn});
    const HandPose& drawn = corrector.update(tracked, object, i * kFrame_ns).pose;
    farthest_m = std::max(farthest_m, farthest_beyond(facing, drawn));
  }
  return farthest_m;
}

/// Pads saw the wall only when it was nearer than the floor; by then fingers were up to 40 mm
/// beyond it.
TEST(ProxyEdge, FingersThatSlideFastIntoAThinWallStayBeforeIt) {
  const std::vector facing{test::Vec3f(test::Vec3f::UnitZ())};
  const Vec3 from(0.0, 0.0, 0.25);
  for (const float thick_m : {0.001F, 0.004F}) {
    for (const double heading : {0.0, 30.0, 90.0}) {
      for (const double speed_mps : {0.8, 1.6}) {
        EXPECT_LT(farthest_on_the_way_through(facing, thick_m, from, test::rad(heading), speed_mps),
                  0.006)
            << thick_m << " m thick, heading " << heading << ", " << speed_mps << " m/s";
      }
    }
  }
}

/// Where three sides meet fingers were up to 5 mm beyond one.
TEST(ProxyEdge, AFastHandStaysInARoomsCorner) {
  const std::vector facing{test::Vec3f(test::Vec3f::UnitX()), test::Vec3f(test::Vec3f::UnitZ())};
  const double direction = test::rad(70.0);
  const Vec3 from = 0.3 * Vec3(std::sin(direction), 0.0, std::cos(direction));
  for (const double heading : {0.0, 45.0}) {
    for (const double speed_mps : {0.8, 1.2}) {
      EXPECT_LT(farthest_on_the_way_through(facing, 0.004F, from, test::rad(heading), speed_mps),
                0.006)
          << "heading " << heading << ", " << speed_mps << " m/s";
    }
  }
}

/// It comes from neither side, and what its pads see on their way out is no corner that they are
/// in: they held it up to 39 mm inside.
TEST(ProxyEdge, AHandFoundInAnInsideCornerComesOut) {
  for (const double corner : {60.0, 90.0}) {
    const auto surface = floor_and_wall(test::rad(corner));
    for (const double heading : {-90.0, 0.0, 90.0}) {
      const Object object = turned(*surface, test::rad(heading));
      for (const double depth_m : {0.02, 0.05, 0.08}) {
        for (const double along_m : {0.0, 0.05, 0.1}) {
          HandCorrector corrector(settling());
          const Vec3 from_wall = object.placement().pose.rotation * Vec3(0.0, 0.0, along_m);
          const HandPose found = pressed_hand(depth_m, 0.0, from_wall);
          const HandPose& drawn = corrector.update(found, object, 0).pose;
          EXPECT_GT(least_room(drawn, object), -0.005)
              << corner << " degrees, heading " << heading << ", " << depth_m << " m deep, "
              << along_m << " m from the wall";
        }
      }
    }
  }
}

}  // namespace
}  // namespace nade
