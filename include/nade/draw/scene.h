#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "nade/draw/image.h"
#include "nade/geometry.h"

namespace nade::draw {

/// Linear light, red green blue.
using Color = Eigen::Vector3f;

/// How a surface meets the light.
struct Material {
  Color base_color{0.7F, 0.7F, 0.7F};
  float roughness = 0.6F;
  float metalness = 0.0F;
  /// Light at the rim, as on cloth or a short coat; 0 to 1.
  float sheen = 0.0F;
  /// Light that goes through flesh and comes out red; 0 to 1.
  float translucency = 0.0F;
};

/// Triangles to draw, in their own frame. What is empty is absent.
struct DrawnMesh {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;  ///< unit, one for each position
  std::vector<Color> colors;             ///< multiply the base colour
  std::vector<Eigen::Vector2f> texcoords;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Material material;
  std::shared_ptr<const Image> texture;  ///< multiplies the base colour; needs texcoords
  /// Of an object's mesh: which vertex of the object each position is.
  std::vector<std::uint32_t> sources;
};

/// A mesh that a Renderer holds.
enum class MeshId : std::uint32_t {};

/// Solid, or seen through like glass; a ghost casts no shadow and hides nothing.
enum class Look : std::uint8_t { solid, ghost };

/// A mesh somewhere in the world.
struct Instance {
  MeshId mesh{};
  Placement placement;
  Look look = Look::solid;
  float opacity = 1.0F;  ///< of a ghost
  Color tint{1.0F, 1.0F, 1.0F};
  /// Of a ghost: how much of it shows, against its opacity, where something solid stands before it.
  float shows_behind = 0.0F;
};

/// Diagram parts, drawn with the scene; where something stands before them they show through
/// faintly.
struct Line {
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();
  Color color{0.0F, 0.0F, 0.0F};
  float width_px = 2.0F;
};
struct Arrow {
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();
  Color color{0.0F, 0.0F, 0.0F};
  float radius_m = 0.0012F;  ///< of the shaft
};
struct Dot {
  Vec3 center = Vec3::Zero();
  Color color{0.0F, 0.0F, 0.0F};
  float radius_m = 0.003F;
};
/// Text that stays upright on the picture, beside a point of the world.
struct Label {
  Vec3 at = Vec3::Zero();
  std::string text;  ///< UTF-8
  Color color{0.0F, 0.0F, 0.0F};
  float height_px = 18.0F;
  Eigen::Vector2f offset_px{8.0F, -8.0F};  ///< right and down
};

/// Half angles of what an eye sees, radians, as XrFovf has them: left and down are negative.
struct FieldOfView {
  double left = -0.4;
  double right = 0.4;
  double up = 0.3;
  double down = -0.3;
};
[[nodiscard]] FieldOfView symmetric_view(double vertical_rad, double aspect);

/// An eye that looks along its own -Z.
struct Camera {
  Pose pose;
  FieldOfView view;
  double near_m = 0.02;
  double far_m = 20.0;
};

/// Everything in one picture.
struct Scene {
  std::vector<Instance> instances;
  std::vector<Line> lines;
  std::vector<Arrow> arrows;
  std::vector<Dot> dots;
  std::vector<Label> labels;
  /// What the shadows are sharpest about: where hand and object meet. Metres.
  Vec3 focus = Vec3::Zero();
  double focus_radius_m = 0.4;
  /// The studio's floor, a soft backdrop that takes shadows.
  bool floor = true;
  double floor_y = 0.0;
  /// Turns the studio's lights about +Y; at 0 they stand for a camera that looks along -Z.
  double light_turn_rad = 0.0;
};

}  // namespace nade::draw
