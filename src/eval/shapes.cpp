#include "nade/eval/shapes.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace nade {
namespace {

constexpr std::uint32_t kRoundSectors = 48;
constexpr std::uint32_t kRoundRings = 24;  // even

/// A point of a profile that is turned about the Y axis.
struct ProfilePoint {
  double radius_m = 0.0;
  double height_m = 0.0;
};

/// The body that a profile encloses when turned; its first and last points lie on the axis, and
/// it runs so that the outside is on its right.
TriangleSoup revolved(const std::vector<ProfilePoint>& profile, std::uint32_t sectors) {
  TriangleSoup soup;
  const auto rings = static_cast<std::uint32_t>(profile.size() - 2);
  const auto on_axis = [&](const ProfilePoint& point) {
    soup.vertices.emplace_back(Vec3(0.0, point.height_m, 0.0).cast<float>());
  };
  on_axis(profile.front());
  for (std::uint32_t ring = 1; ring <= rings; ++ring) {
    for (std::uint32_t sector = 0; sector < sectors; ++sector) {
      const double turn = 2.0 * std::numbers::pi * sector / sectors;
      const ProfilePoint& point = profile[ring];
      soup.vertices.emplace_back(
          Vec3(point.radius_m * std::sin(turn), point.height_m, point.radius_m * std::cos(turn))
              .cast<float>());
    }
  }
  on_axis(profile.back());
  const auto last = static_cast<std::uint32_t>(soup.vertices.size() - 1);
  const auto at = [&](std::uint32_t ring, std::uint32_t sector) {
    return 1 + (ring - 1) * sectors + sector % sectors;
  };
  for (std::uint32_t sector = 0; sector < sectors; ++sector) {
    soup.triangles.push_back({0, at(1, sector + 1), at(1, sector)});
    for (std::uint32_t ring = 1; ring < rings; ++ring) {
      soup.triangles.push_back({at(ring, sector), at(ring + 1, sector + 1), at(ring + 1, sector)});
      soup.triangles.push_back({at(ring, sector), at(ring, sector + 1), at(ring + 1, sector + 1)});
    }
    soup.triangles.push_back({at(rings, sector), at(rings, sector + 1), last});
  }
  return soup;
}

TriangleSoup moved_by(TriangleSoup soup, const Vec3& by) {
  for (Eigen::Vector3f& vertex : soup.vertices) vertex += by.cast<float>();
  return soup;
}

}  // namespace

TriangleSoup box_soup(const Vec3& half_size_m) {
  const Eigen::Vector3f half = half_size_m.cast<float>();
  TriangleSoup soup;
  for (int i = 0; i < 8; ++i) {
    soup.vertices.emplace_back((i & 1) != 0 ? half.x() : -half.x(),
                               (i & 2) != 0 ? half.y() : -half.y(),
                               (i & 4) != 0 ? half.z() : -half.z());
  }
  soup.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return soup;
}

TriangleSoup bowl_soup(const BowlSize& size) {
  std::vector<ProfilePoint> profile;
  const double outer_m = size.inner_radius_m + size.thickness_m;
  const auto add = [&](double radius_m, std::uint32_t ring) {
    const double polar = 0.5 * std::numbers::pi * ring / size.rings;
    profile.push_back(
        {radius_m * std::sin(polar), size.inner_radius_m - radius_m * std::cos(polar)});
  };
  for (std::uint32_t ring = 0; ring <= size.rings; ++ring) add(outer_m, ring);
  for (std::uint32_t ring = 0; ring <= size.rings; ++ring) {
    add(size.inner_radius_m, size.rings - ring);
  }
  return revolved(profile, size.sectors);
}

TriangleSoup capsule_soup(double radius_m, double length_m) {
  std::vector<ProfilePoint> profile;
  for (std::uint32_t ring = 0; ring <= kRoundRings; ++ring) {
    const double polar = std::numbers::pi * ring / kRoundRings;
    const bool is_upper = 2 * ring > kRoundRings;
    // The middle ring stands at both ends of a rod.
    profile.push_back({radius_m * std::sin(polar),
                       (is_upper ? 0.5 : -0.5) * length_m - radius_m * std::cos(polar)});
    if (2 * ring == kRoundRings && length_m > 0.0) profile.push_back({radius_m, 0.5 * length_m});
  }
  return revolved(profile, kRoundSectors);
}

TriangleSoup cup_soup(double radius_m, double height_m, double wall_m) {
  const double inner_m = radius_m - wall_m;
  return revolved({{0.0, 0.0},
                   {radius_m, 0.0},
                   {radius_m, height_m},
                   {inner_m, height_m},
                   {inner_m, wall_m},
                   {0.0, wall_m}},
                  kRoundSectors);
}

MeshFile bowl_shape() { return {bowl_soup(), {{"bottom", {}}}}; }

MeshFile board_shape() {
  const Vec3 half(0.2, 0.005, 0.15);
  return {moved_by(box_soup(half), Vec3(0.0, -half.y(), 0.0)), {{"top", {}}}};
}

MeshFile box_shape() {
  const Vec3 half(0.2, 0.1, 0.15);
  const Quat aside(Eigen::AngleAxisd(-0.5 * std::numbers::pi, Vec3::UnitY()));
  return {moved_by(box_soup(half), Vec3(0.0, -half.y(), half.z())),
          {{"across", {}}, {"along", {Vec3::Zero(), aside}}}};
}

Result<LoadedObject> shape_object(const std::string& spec, MeshFile shape) {
  auto surface = MeshSurface::build(shape.soup, spec);
  if (!surface) return surface.error();
  LoadedObject object;
  object.spec = spec;
  object.surface = std::move(surface).value();
  object.places = std::move(shape.places);
  object.soup = std::move(shape.soup);
  return object;
}

}  // namespace nade
