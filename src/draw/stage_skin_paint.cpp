#include <algorithm>
#include <cmath>
#include <optional>

#include "../ramps.h"
#include "object_look.h"
#include "stage_skin.h"

namespace nade::draw {
namespace {

using Vec2f = Eigen::Vector2f;
using Vec3f = Eigen::Vector3f;

constexpr int kTextureSize = 1024;
/// Colour runs on so far past the border of what the texture covers, against blended seams.
constexpr int kGutter = 8;
/// Where more than this share of the texels is claimed twice, the texture coordinates overlap.
constexpr double kMostOverlap = 0.02;

float bump(float x, float width) { return std::exp(-0.5F * x * x / (width * width)); }

void mix(Color& color, const Color& other, float share) { color += share * (other - color); }

/// The same number for the same cell, 0 to 1.
float cell_noise(int x, int y, int z) {
  auto h = static_cast<std::uint32_t>(x) * 0x8da6b343U ^
           static_cast<std::uint32_t>(y) * 0xd8163841U ^
           static_cast<std::uint32_t>(z) * 0xcb1ab31fU;
  h = (h ^ (h >> 15U)) * 0x2c1b3c6dU;
  h = (h ^ (h >> 12U)) * 0x297a2d39U;
  return static_cast<float>((h ^ (h >> 15U)) & 0xffffU) / 65535.0F;
}

/// Smooth noise, -1 to 1, that changes over `size`.
float noise(const Vec3f& point, float size) {
  const Vec3f p = point / size;
  std::array<int, 3> cell{};
  Vec3f t;
  for (int k = 0; k < 3; ++k) {
    const float floor = std::floor(p[k]);
    cell[static_cast<std::size_t>(k)] = static_cast<int>(floor);
    t[k] = smoothstep(0.0F, 1.0F, p[k] - floor);
  }
  float sum = 0.0F;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1;
    const int j = (corner >> 1) & 1;
    const int k = corner >> 2;
    const float weight = (i != 0 ? t.x() : 1.0F - t.x()) * (j != 0 ? t.y() : 1.0F - t.y()) *
                         (k != 0 ? t.z() : 1.0F - t.z());
    sum += weight * cell_noise(cell[0] + i, cell[1] + j, cell[2] + k);
  }
  return 2.0F * sum - 1.0F;
}

/// A joint's frame for many points: -Z to the tip, +Y to the back.
struct Frame {
  Vec3f origin = Vec3f::Zero();
  Eigen::Matrix3f to_local = Eigen::Matrix3f::Identity();

  explicit Frame(const Pose& pose)
      : origin(pose.position.cast<float>()),
        to_local(pose.rotation.conjugate().toRotationMatrix().cast<float>()) {}
  [[nodiscard]] Vec3f local(const Vec3f& point) const { return to_local * (point - origin); }
  [[nodiscard]] float dorsal(const Vec3f& normal) const { return to_local.row(1).dot(normal); }
};

/// A spot of the skin in the bind pose.
struct Spot {
  Vec3f point = Vec3f::Zero();
  Vec3f normal = Vec3f::UnitY();
  std::array<float, kDigitCount> digit{};  ///< weight of each digit's phalanges
  float dorsal = 0.0F;                     ///< 1 on the back of its bone, -1 on the palm's side
};

/// One fingertip's measures, in the frame of its tip joint.
struct Fingertip {
  float end = 0.0F;         ///< the farthest skin, along -Z
  float half_width = 0.0F;  ///< of the finger under the nail
};

class Painter {
 public:
  explicit Painter(const HandMesh& mesh)
      : scale_(static_cast<float>(hand_length(mesh.bind) / kGenericHandLength)) {
    for (const Pose& pose : mesh.bind.joints) frames_.emplace_back(pose);
    SkinPoser poser(mesh);
    poser.pose(mesh.bind, 1.0);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      spots_.push_back(spot_of(mesh, i, poser.normals()[i]));
    }
    for (std::size_t d = 0; d < kDigitCount; ++d) measure_tip(digit_at(d));
  }

  [[nodiscard]] const Spot& spot(std::size_t vertex) const { return spots_[vertex]; }

  /// The colour of a spot, linear light.
  [[nodiscard]] Color paint(const Spot& spot) const {
    Color color(0.915F, 0.735F, 0.635F);  // sRGB, the back of the hand
    const float palmar = smoothstep(0.15F, -0.65F, spot.dorsal);
    mix(color, {0.945F, 0.735F, 0.665F}, palmar);
    const float patches =
        0.6F * noise(spot.point, 0.016F * scale_) + 0.4F * noise(spot.point, 0.005F * scale_);
    color += 0.018F * patches * Color(1.0F, -0.3F, -0.4F);
    for (std::size_t d = 0; d < kDigitCount; ++d) {
      if (spot.digit[d] > 0.02F) paint_digit(digit_at(d), spot, palmar, color);
    }
    return from_srgb(color);
  }

 private:
  [[nodiscard]] const Frame& frame(Joint joint) const { return frames_[index_of(joint)]; }

  [[nodiscard]] Spot spot_of(const HandMesh& mesh, std::size_t i, const Vec3f& normal) const {
    Spot spot{mesh.vertices[i], normal, {}, 0.0F};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t bone = mesh.bones[i][k];
      const float weight = mesh.weights[i][k];
      spot.dorsal += weight * frames_[bone].dorsal(normal);
      for (std::size_t d = 0; d < kDigitCount; ++d) {
        const DigitJoints joints = joints_of(digit_at(d));
        if (bone > index_of(joints.metacarpal) && bone <= index_of(joints.tip)) {
          spot.digit[d] += weight;
        }
      }
    }
    return spot;
  }

  void measure_tip(Digit digit) {
    Fingertip& tip = tips_[index_of(digit)];
    const Frame& at = frame(joints_of(digit).tip);
    for (const Spot& spot : spots_) {
      if (spot.digit[index_of(digit)] < 0.5F) continue;
      const Vec3f local = at.local(spot.point);
      if (local.norm() > 0.03F * scale_) continue;
      tip.end = std::max(tip.end, -local.z());
      if (std::abs(local.z()) < 0.009F * scale_) {
        tip.half_width = std::max(tip.half_width, std::abs(local.x()));
      }
    }
  }

  void paint_digit(Digit digit, const Spot& spot, float palmar, Color& color) const {
    const float own = std::min(1.0F, spot.digit[index_of(digit)]);
    const DigitJoints joints = joints_of(digit);
    const Color flushed(0.87F, 0.60F, 0.53F);
    const float dorsal = 1.0F - palmar;
    for (std::size_t j = index_of(joints.metacarpal) + 1; j < index_of(joints.tip); ++j) {
      const Frame& joint = frames_[j];
      const Vec3f local = joint.local(spot.point);
      const bool knuckle = j == index_of(joints.metacarpal) + 1;
      const float along = local.z() / scale_;
      if (std::abs(along) > 0.03F) continue;
      mix(color, flushed, own * dorsal * (knuckle ? 0.30F : 0.26F) * bump(along, 0.0055F));
      if (knuckle) continue;
      float creases = 0.0F;
      for (int line = -1; line <= 1; ++line) {
        creases += bump(along - 0.0019F * static_cast<float>(line), 0.00045F);
      }
      mix(color, {0.55F, 0.36F, 0.30F}, own * 0.13F * std::min(1.0F, creases) * dorsal);
      const float folds = bump(along, 0.0006F) + bump(along - 0.0022F, 0.0005F);
      mix(color, {0.62F, 0.36F, 0.31F}, own * 0.24F * std::min(1.0F, folds) * palmar);
    }
    const Fingertip& tip = tips_[index_of(digit)];
    const Vec3f local = frame(joints.tip).local(spot.point);
    const float from_end = (tip.end + local.z()) / scale_;
    mix(color, {0.925F, 0.635F, 0.58F},
        own * (0.35F + 0.35F * palmar) * smoothstep(0.020F, 0.006F, from_end));
    paint_nail(digit, spot, local, color);
  }

  void paint_nail(Digit digit, const Spot& spot, const Vec3f& local, Color& color) const {
    const Fingertip& tip = tips_[index_of(digit)];
    if (!(tip.half_width > 0.0F)) return;
    const float half_width = 0.63F * tip.half_width;
    const float length = 2.15F * half_width;
    const float start = tip.end - 0.0018F * scale_;  // the free edge
    const float v = (start + local.z()) / length;    // 0 at the free edge, 1 at the root
    const float u = local.x() / half_width;
    const float facing = frame(joints_of(digit).tip).dorsal(spot.normal);
    if (v < -0.2F || v > 1.3F || std::abs(u) > 1.3F || facing < 0.0F) return;
    const float w = 2.0F * v - 1.0F;
    const float edge =
        std::pow(std::pow(std::abs(u), 3.5F) + std::pow(std::abs(w), 3.5F), 1 / 3.5F);
    const float on_back = smoothstep(0.05F, 0.30F, facing);
    mix(color, {0.70F, 0.46F, 0.40F}, 0.55F * on_back * bump(edge - 1.02F, 0.07F));
    Color nail(0.955F, 0.785F, 0.735F);
    mix(nail, {0.95F, 0.86F, 0.81F}, 0.8F * smoothstep(0.80F, 0.90F, v));
    mix(nail, {0.955F, 0.915F, 0.875F}, smoothstep(0.17F, 0.09F, v));
    mix(color, nail, on_back * smoothstep(1.02F, 0.92F, edge));
  }

  float scale_;
  std::vector<Frame> frames_;
  std::vector<Spot> spots_;
  std::array<Fingertip, kDigitCount> tips_{};
};

Spot blend(const std::array<const Spot*, 3>& corners, const Vec3f& weights) {
  Spot spot{Vec3f::Zero(), Vec3f::Zero(), {}, 0.0F};
  for (int k = 0; k < 3; ++k) {
    const Spot& corner = *corners[static_cast<std::size_t>(k)];
    spot.point += weights[k] * corner.point;
    spot.normal += weights[k] * corner.normal;
    spot.dorsal += weights[k] * corner.dorsal;
    for (std::size_t d = 0; d < kDigitCount; ++d) spot.digit[d] += weights[k] * corner.digit[d];
  }
  spot.normal.normalize();
  return spot;
}

/// A picture being painted through a mesh's texture coordinates.
struct Canvas {
  Image image = Image::blank(kTextureSize, kTextureSize);
  std::vector<std::uint8_t> times =
      std::vector<std::uint8_t>(std::size_t{kTextureSize} * kTextureSize, 0);

  void set(std::size_t index, const Color& linear) {
    const Color srgb = to_srgb(linear);
    for (std::size_t k = 0; k < 3; ++k) {
      image.rgba[4 * index + k] =
          static_cast<std::uint8_t>(std::lround(255.0F * srgb[static_cast<int>(k)]));
    }
    image.rgba[4 * index + 3] = 255;
  }
};

float cross(const Vec2f& a, const Vec2f& b) { return a.x() * b.y() - a.y() * b.x(); }

void paint_triangle(const HandMesh& mesh, const std::array<std::uint32_t, 3>& triangle,
                    const Painter& painter, Canvas& canvas) {
  std::array<Vec2f, 3> at;
  std::array<const Spot*, 3> corners{};
  for (std::size_t k = 0; k < 3; ++k) {
    at[k] = static_cast<float>(kTextureSize) * mesh.texcoords[triangle[k]];
    corners[k] = &painter.spot(triangle[k]);
  }
  const float area = cross(at[1] - at[0], at[2] - at[0]);
  if (std::abs(area) < 1e-6F) return;
  const Vec2f low = at[0].cwiseMin(at[1]).cwiseMin(at[2]).cwiseMax(0.0F);
  const Vec2f high = at[0].cwiseMax(at[1]).cwiseMax(at[2]).cwiseMin(kTextureSize - 1.0F);
  for (int y = static_cast<int>(low.y()); y <= static_cast<int>(high.y()); ++y) {
    for (int x = static_cast<int>(low.x()); x <= static_cast<int>(high.x()); ++x) {
      const Vec2f p(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      const float b = cross(p - at[0], at[2] - at[0]) / area;
      const float c = cross(at[1] - at[0], p - at[0]) / area;
      const Vec3f weights(1.0F - b - c, b, c);
      if (weights.minCoeff() < 0.0F) continue;
      const auto index = static_cast<std::size_t>(y) * kTextureSize + static_cast<std::size_t>(x);
      if (canvas.times[index] < 2) ++canvas.times[index];
      canvas.set(index, painter.paint(blend(corners, weights)));
    }
  }
}

/// Lets colours run out over the border of what is painted.
void spread(Canvas& canvas) {
  constexpr std::size_t kSize = kTextureSize;
  std::vector<std::uint8_t> ring(canvas.times);
  for (int pass = 1; pass <= kGutter; ++pass) {
    const std::vector<std::uint8_t> before(ring);
    for (std::size_t y = 1; y + 1 < kSize; ++y) {
      for (std::size_t x = 1; x + 1 < kSize; ++x) {
        const std::size_t index = y * kSize + x;
        if (before[index] != 0) continue;
        for (const std::size_t from : {index - 1, index + 1, index - kSize, index + kSize}) {
          if (before[from] == 0) continue;
          std::copy_n(canvas.image.rgba.begin() + static_cast<std::ptrdiff_t>(4 * from), 4,
                      canvas.image.rgba.begin() + static_cast<std::ptrdiff_t>(4 * index));
          ring[index] = 1;
          break;
        }
      }
    }
  }
}

/// No value where the mesh has no texture coordinates that tell its spots apart.
std::optional<Image> paint_texture(const HandMesh& mesh, const Painter& painter) {
  const bool inside = mesh.texcoords.size() == mesh.vertices.size() &&
                      std::all_of(mesh.texcoords.begin(), mesh.texcoords.end(), [](const Vec2f& t) {
                        return t.allFinite() && t.minCoeff() >= 0.0F && t.maxCoeff() <= 1.0F;
                      });
  if (!inside) return std::nullopt;
  Canvas canvas;
  for (const auto& triangle : mesh.triangles) paint_triangle(mesh, triangle, painter, canvas);
  const auto painted = canvas.times.size() - static_cast<std::size_t>(std::count(
                                                 canvas.times.begin(), canvas.times.end(), 0));
  const auto twice = std::count(canvas.times.begin(), canvas.times.end(), 2);
  // A mesh whose spots share a few texels has no room for the picture either.
  constexpr std::size_t kLeastTexels = std::size_t{kTextureSize} * kTextureSize / 50;
  if (painted < kLeastTexels ||
      static_cast<double>(twice) > kMostOverlap * static_cast<double>(painted)) {
    return std::nullopt;
  }
  spread(canvas);
  return std::move(canvas.image);
}

}  // namespace

DrawnMesh paint_skin(const HandMesh& mesh) {
  DrawnMesh drawn = plain_hand(mesh);
  drawn.material.roughness = 0.48F;
  drawn.material.translucency = 0.55F;
  const Painter painter(mesh);
  if (std::optional<Image> texture = paint_texture(mesh, painter)) {
    drawn.texcoords = mesh.texcoords;
    drawn.texture = std::make_shared<const Image>(std::move(*texture));
    return drawn;
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    drawn.colors.push_back(painter.paint(painter.spot(i)));
  }
  return drawn;
}

}  // namespace nade::draw
