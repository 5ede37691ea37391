#include "model_options.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace nade::cli {
namespace {

constexpr float kPlaneHalf_m = 0.5F;
constexpr std::uint32_t kBallSectors = 64;
constexpr std::uint32_t kBallRings = 32;

TriangleSoup piece_of_plane() {
  const float s = kPlaneHalf_m;
  return {{{-s, 0, -s}, {-s, 0, s}, {s, 0, s}, {s, 0, -s}}, {{0, 1, 2}, {0, 2, 3}}};
}

TriangleSoup ball(double radius_m) {
  TriangleSoup soup;
  for (std::uint32_t ring = 0; ring <= kBallRings; ++ring) {
    const double polar = std::numbers::pi * ring / kBallRings;
    for (std::uint32_t sector = 0; sector <= kBallSectors; ++sector) {
      const double around = 2.0 * std::numbers::pi * sector / kBallSectors;
      const Vec3 out(std::sin(polar) * std::cos(around), std::cos(polar),
                     -std::sin(polar) * std::sin(around));
      soup.vertices.emplace_back((radius_m * out).cast<float>());
    }
  }
  for (std::uint32_t ring = 0; ring < kBallRings; ++ring) {
    for (std::uint32_t sector = 0; sector < kBallSectors; ++sector) {
      const std::uint32_t a = ring * (kBallSectors + 1) + sector;
      const std::uint32_t b = a + kBallSectors + 1;
      soup.triangles.push_back({a, b, b + 1});
      soup.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return soup;
}

}  // namespace

void add_model_choice(CLI::App& command, ModelChoice& choice) {
  command.add_flag("--flat", choice.flat,
                   "in a .glb all joints hang on the hand, not each on the one before it");
  command.add_flag("--with-object", choice.with_object, "in a .glb the object is there, too");
}

std::shared_ptr<const TriangleSoup> shown_object(const PlacedObject& placed) {
  TriangleSoup soup;
  Placement at = placed.placement;
  if (placed.loaded.soup) {
    soup = *placed.loaded.soup;
  } else if (const auto* sphere = dynamic_cast<const SphereSurface*>(placed.loaded.surface.get())) {
    soup = ball(sphere->radius());
    at = composed(at, placed.loaded.base);
  } else {
    soup = piece_of_plane();
  }
  for (Eigen::Vector3f& vertex : soup.vertices) {
    const Vec3 scaled = at.scale * vertex.cast<double>();
    vertex = (at.pose.position + at.pose.rotation * scaled).cast<float>();
  }
  return std::make_shared<const TriangleSoup>(std::move(soup));
}

}  // namespace nade::cli
