#include "object_look.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "../ramps.h"

namespace nade::draw {
namespace {

using Vec2f = Eigen::Vector2f;
using Vec3f = Eigen::Vector3f;
using Triangle = std::array<std::uint32_t, 3>;

constexpr float kPi = std::numbers::pi_v<float>;

// The table top: a slab with rounded corners and edges, its top the plane y = 0.
constexpr float kTableHalfX = 0.70F;
constexpr float kTableHalfZ = 0.50F;
constexpr float kTableThickness = 0.035F;
constexpr float kTableCorner = 0.06F;
constexpr float kTableEdge = 0.008F;
constexpr float kGridStep = 0.05F;
constexpr float kTableWeave = 0.006F;

float channel_to_srgb(float c) {
  return c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1.0F / 2.4F) - 0.055F;
}
float channel_from_srgb(float c) {
  return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
}

/// The outline of the table at an inset from its widest.
std::vector<Vec2f> rounded_rectangle(float inset) {
  constexpr int kCornerSteps = 10;
  const float radius = kTableCorner - inset;
  std::vector<Vec2f> outline;
  for (int corner = 0; corner < 4; ++corner) {
    const float sign_x = corner == 0 || corner == 3 ? 1.0F : -1.0F;
    const float sign_z = corner < 2 ? 1.0F : -1.0F;
    const Vec2f center(sign_x * (kTableHalfX - kTableCorner),
                       sign_z * (kTableHalfZ - kTableCorner));
    for (int i = 0; i <= kCornerSteps; ++i) {
      const float angle =
          0.5F * kPi *
          (static_cast<float>(corner) + static_cast<float>(i) / static_cast<float>(kCornerSteps));
      outline.push_back(center + radius * Vec2f(std::cos(angle), std::sin(angle)));
    }
  }
  return outline;
}

Vec2f table_texcoord(float x, float z) {
  return {0.5F + 0.5F * x / kTableHalfX, 0.5F + 0.5F * z / kTableHalfZ};
}

/// Joins the last two rings of `count` vertices with a band of triangles.
void join_rings(std::uint32_t count, DrawnMesh& mesh) {
  const auto lower = static_cast<std::uint32_t>(mesh.positions.size()) - count;
  const std::uint32_t upper = lower - count;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    mesh.triangles.push_back({upper + i, upper + next, lower + i});
    mesh.triangles.push_back({upper + next, lower + next, lower + i});
  }
}

/// A soft grid, a line every 5 cm and a stronger one every 25, on a quiet ground.
std::shared_ptr<const Image> table_texture() {
  constexpr int kPixelsAMetre = 1200;
  const auto image =
      std::make_shared<Image>(Image::blank(static_cast<int>(2.0F * kTableHalfX * kPixelsAMetre),
                                           static_cast<int>(2.0F * kTableHalfZ * kPixelsAMetre)));
  const auto line = [](float metres, float step, float half_width) {
    const float away = std::abs(metres / step - std::round(metres / step)) * step;
    return 1.0F - smoothstep(half_width, half_width + 0.0012F, away);
  };
  std::uint8_t* pixel = image->rgba.data();
  for (int row = 0; row < image->height; ++row) {
    for (int column = 0; column < image->width; ++column, pixel += 4) {
      const float x = (static_cast<float>(column) + 0.5F) / kPixelsAMetre - kTableHalfX;
      const float z = (static_cast<float>(row) + 0.5F) / kPixelsAMetre - kTableHalfZ;
      const float fine = std::max(line(x, kGridStep, 0.0004F), line(z, kGridStep, 0.0004F));
      const float strong =
          std::max(line(x, 5.0F * kGridStep, 0.0008F), line(z, 5.0F * kGridStep, 0.0008F));
      const float mark = std::max(0.13F * fine, 0.28F * strong);
      const Color ground(0.57F, 0.66F, 0.70F);
      const Color color = (1.0F - mark) * ground + mark * Color(0.22F, 0.31F, 0.38F);
      for (int k = 0; k < 3; ++k) {
        pixel[k] = static_cast<std::uint8_t>(std::lround(255.0F * color[k]));
      }
      pixel[3] = 255;
    }
  }
  return image;
}

void add_ring(float inset, float y, const Vec2f& slope, DrawnMesh& mesh) {
  const std::vector<Vec2f> outline = rounded_rectangle(inset);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2f& before = outline[(i + outline.size() - 1) % outline.size()];
    const Vec2f& after = outline[(i + 1) % outline.size()];
    const Vec2f along = (after - before).normalized();
    const Vec2f out(along.y(), -along.x());
    mesh.positions.emplace_back(outline[i].x(), y, outline[i].y());
    mesh.normals.emplace_back(out.x() * slope.x(), slope.y(), out.y() * slope.x());
    mesh.texcoords.push_back(table_texcoord(outline[i].x(), outline[i].y()));
  }
  const auto count = static_cast<std::uint32_t>(outline.size());
  if (mesh.positions.size() > count + 1) join_rings(count, mesh);
}

/// The nearest point of the table's flat top.
Vec2f onto_top(const Vec2f& point) {
  const Vec2f inner(kTableHalfX - kTableCorner, kTableHalfZ - kTableCorner);
  const Vec2f nearest = point.cwiseMax(-inner).cwiseMin(inner);
  const Vec2f beyond = point - nearest;
  const float radius = kTableCorner - kTableEdge;
  return beyond.norm() > radius ? Vec2f(nearest + radius / beyond.norm() * beyond) : point;
}

/// The flat top as a fine grid, its corners drawn in.
void weave_top(DrawnMesh& mesh) {
  const Vec2f half(kTableHalfX - kTableEdge, kTableHalfZ - kTableEdge);
  const auto columns = static_cast<std::uint32_t>(std::ceil(2.0F * half.x() / kTableWeave));
  const auto rows = static_cast<std::uint32_t>(std::ceil(2.0F * half.y() / kTableWeave));
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t row = 0; row <= rows; ++row) {
    for (std::uint32_t column = 0; column <= columns; ++column) {
      const Vec2f share(static_cast<float>(column) / static_cast<float>(columns),
                        static_cast<float>(row) / static_cast<float>(rows));
      const Vec2f at = onto_top(half.cwiseProduct(2.0F * share - Vec2f::Ones()));
      mesh.positions.emplace_back(at.x(), 0.0F, at.y());
      mesh.normals.emplace_back(Vec3f::UnitY());
      mesh.texcoords.push_back(table_texcoord(at.x(), at.y()));
      if (row == rows || column == columns) continue;
      const std::uint32_t a = first + row * (columns + 1) + column;
      const std::uint32_t below = a + columns + 1;
      mesh.triangles.push_back({a, below, a + 1});
      mesh.triangles.push_back({a + 1, below, below + 1});
    }
  }
}

DrawnMesh make_table(Weave weave) {
  constexpr int kEdgeSteps = 6;
  DrawnMesh mesh;
  mesh.positions.emplace_back(0.0F, 0.0F, 0.0F);
  mesh.normals.emplace_back(Vec3f::UnitY());
  mesh.texcoords.push_back(table_texcoord(0.0F, 0.0F));
  for (int i = 0; i <= kEdgeSteps; ++i) {
    const float angle = 0.5F * kPi * static_cast<float>(i) / kEdgeSteps;
    add_ring(kTableEdge * (1.0F - std::sin(angle)), -kTableEdge * (1.0F - std::cos(angle)),
             {std::sin(angle), std::cos(angle)}, mesh);
  }
  add_ring(0.0F, -kTableThickness, {1.0F, 0.0F}, mesh);
  const auto count = static_cast<std::uint32_t>(rounded_rectangle(0.0F).size());
  if (weave == Weave::fine) {
    weave_top(mesh);
  } else {
    for (std::uint32_t i = 0; i < count; ++i) {
      mesh.triangles.push_back({0, 1 + (i + 1) % count, 1 + i});
    }
  }
  mesh.texture = table_texture();
  mesh.material.base_color = Color::Ones();
  mesh.material.roughness = 0.55F;
  return mesh;
}

DrawnMesh make_ball(const Vec3f& center, float radius) {
  constexpr std::uint32_t kAround = 256;
  constexpr std::uint32_t kDown = 128;
  DrawnMesh mesh;
  for (std::uint32_t i = 0; i <= kDown; ++i) {
    const float polar = kPi * static_cast<float>(i) / kDown;
    for (std::uint32_t j = 0; j <= kAround; ++j) {
      const float turn = 2.0F * kPi * static_cast<float>(j) / kAround;
      const Vec3f normal(std::sin(polar) * std::sin(turn), std::cos(polar),
                         std::sin(polar) * std::cos(turn));
      mesh.normals.push_back(normal);
      mesh.positions.emplace_back(center + radius * normal);
    }
  }
  for (std::uint32_t i = 0; i < kDown; ++i) {
    for (std::uint32_t j = 0; j < kAround; ++j) {
      const std::uint32_t a = i * (kAround + 1) + j;
      const std::uint32_t b = a + kAround + 1;
      if (i > 0) mesh.triangles.push_back({a, b, a + 1});
      if (i + 1 < kDown) mesh.triangles.push_back({a + 1, b, b + 1});
    }
  }
  mesh.material.base_color = from_srgb({0.30F, 0.55F, 0.58F});
  mesh.material.roughness = 0.38F;
  return mesh;
}

/// What glistens on the dog, told by its colour: nose, pupils, irises and their glints.
bool glistens(const Color& linear) {
  const Color c = to_srgb(linear);
  const bool dark = c.maxCoeff() < 0.115F;
  const bool iris = c.x() < 0.36F && c.y() < 0.19F && c.z() < 0.08F;
  const bool glint = c.minCoeff() > 0.86F;
  return dark || iris || glint;
}

/// The mesh with only the triangles that `keep` says.
template <class Keep>
DrawnMesh part_of(const DrawnMesh& mesh, const Keep& keep) {
  DrawnMesh part;
  part.material = mesh.material;
  std::vector<std::uint32_t> place(mesh.positions.size(), std::numeric_limits<uint32_t>::max());
  for (const Triangle& triangle : mesh.triangles) {
    if (!keep(triangle)) continue;
    Triangle kept{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = triangle[k];
      if (place[vertex] == std::numeric_limits<uint32_t>::max()) {
        place[vertex] = static_cast<std::uint32_t>(part.positions.size());
        part.positions.push_back(mesh.positions[vertex]);
        if (!mesh.normals.empty()) part.normals.push_back(mesh.normals[vertex]);
        part.colors.push_back(mesh.colors[vertex]);
        if (!mesh.sources.empty()) part.sources.push_back(mesh.sources[vertex]);
      }
      kept[k] = place[vertex];
    }
    part.triangles.push_back(kept);
  }
  return part;
}

/// Parts eyes and nose from the coat, so that they can shine.
void groom(DressedObject& dog) {
  std::vector<DrawnMesh> groomed;
  for (DrawnMesh& mesh : dog.meshes) {
    mesh.material.sheen = 0.7F;
    mesh.material.roughness = 0.9F;
    if (mesh.colors.empty()) {
      groomed.push_back(std::move(mesh));
      continue;
    }
    const auto wet = [&mesh](const Triangle& t) {
      return std::all_of(t.begin(), t.end(),
                         [&mesh](std::uint32_t v) { return glistens(mesh.colors[v]); });
    };
    DrawnMesh shiny = part_of(mesh, wet);
    shiny.material.sheen = 0.0F;
    shiny.material.roughness = 0.16F;
    groomed.push_back(part_of(mesh, [&wet](const Triangle& t) { return !wet(t); }));
    if (!shiny.triangles.empty()) groomed.push_back(std::move(shiny));
  }
  dog.meshes = std::move(groomed);
}

DressedObject dress_soup(const TriangleSoup& soup) {
  DrawnMesh mesh;
  mesh.positions = soup.vertices;
  mesh.triangles = soup.triangles;
  mesh.material.base_color = from_srgb({0.72F, 0.69F, 0.64F});
  compute_creased_normals(mesh);
  return {{std::move(mesh)}, {}};
}

/// In one colour where the reader of looks finds other triangles than the solid has.
DressedObject dress_plain(const std::string& path, const TriangleSoup& soup) {
  Result<DressedObject> dressed = load_plain_meshes(path);
  std::size_t triangles = 0;
  if (dressed) {
    for (const DrawnMesh& mesh : dressed->meshes) triangles += mesh.triangles.size();
  }
  if (triangles == soup.triangles.size()) return std::move(*dressed);
  DressedObject plain = dress_soup(soup);
  plain.warnings.push_back(path + ": drawn in one colour, for its own cannot be read");
  return plain;
}

/// A mesh file in its own materials, or, where its format has none, in one colour.
Result<DressedObject> dress_file(const std::string& path, const LoadedObject& object) {
  const std::string ending = ending_of(path);
  if (ending == ".glb" || ending == ".gltf") return load_gltf_meshes(path);
  static const TriangleSoup kNone;
  const TriangleSoup& soup = object.soup ? *object.soup : kNone;
  return ending == ".obj" || ending == ".ply" ? dress_plain(path, soup) : dress_soup(soup);
}

/// Most of the triangles wound against the solid's own surface: turned, as the surface was.
void face_outward(const LoadedObject& object, DrawnMesh& mesh) {
  constexpr std::size_t kSamples = 500;
  const Object solid = object.placed();
  const std::size_t stride = std::max<std::size_t>(1, mesh.triangles.size() / kSamples);
  std::ptrdiff_t balance = 0;
  SurfaceHint hint;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += stride) {
    const auto [i, j, k] = mesh.triangles[t];
    const Vec3f& a = mesh.positions[i];
    const Vec3 normal = (mesh.positions[j] - a).cross(mesh.positions[k] - a).cast<double>();
    const Vec3 middle = ((a + mesh.positions[j] + mesh.positions[k]) / 3.0F).cast<double>();
    const auto nearest = solid.closest_point(middle, 0.1, hint);
    if (nearest) balance += normal.dot(nearest->normal) < 0.0 ? -1 : 1;
  }
  if (balance >= 0) return;
  for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  for (Vec3f& normal : mesh.normals) normal = -normal;
}

/// Leaves out triangles, evenly, where they lie in so many layers that drawing them would take
/// minutes.
void thin_layers(const std::string& path, DressedObject& object) {
  constexpr double kMostLayers = 16.0;
  Eigen::AlignedBox3f box;
  double area = 0.0;
  std::size_t triangles = 0;
  for (const DrawnMesh& mesh : object.meshes) {
    for (const Vec3f& position : mesh.positions) box.extend(position);
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3f& from = mesh.positions[a];
      const Vec3f cross = (mesh.positions[b] - from).cross(mesh.positions[c] - from);
      area += 0.5 * static_cast<double>(cross.norm());
    }
    triangles += mesh.triangles.size();
  }
  if (triangles == 0) return;
  const Vec3 size = box.sizes().cast<double>();
  const double around = 2.0 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
  const double layers = area / around;
  if (!(layers > kMostLayers)) return;
  const auto step = static_cast<std::size_t>(std::ceil(layers / kMostLayers));
  for (DrawnMesh& mesh : object.meshes) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += step) {
      mesh.triangles[kept++] = mesh.triangles[i];
    }
    mesh.triangles.resize(kept);
  }
  object.warnings.push_back(fmt::format(
      "{}: its triangles lie in {:.0f} layers: drawn with one in {} of them", path, layers, step));
}

}  // namespace

Color from_srgb(const Color& srgb) { return srgb.unaryExpr(&channel_from_srgb); }
Color to_srgb(const Color& linear) {
  return linear.cwiseMax(0.0F).cwiseMin(1.0F).unaryExpr(&channel_to_srgb);
}

Result<DressedObject> dress(const LoadedObject& object, Weave weave) {
  if (dynamic_cast<const PlaneSurface*>(object.surface.get()) != nullptr) {
    return DressedObject{{make_table(weave)}, {}};
  }
  if (const auto* const ball = dynamic_cast<const SphereSurface*>(object.surface.get())) {
    return DressedObject{{make_ball(object.base.pose.position.cast<float>(),
                                    static_cast<float>(ball->radius() * object.base.scale))},
                         {}};
  }
  const bool is_dog = object.spec == "dog" || object.spec.starts_with("dog:");
  const std::string& path = object.file.empty() ? object.spec : object.file;
  Result<DressedObject> dressed = dress_file(path, object);
  if (!dressed) return dressed.error();
  thin_layers(path, *dressed);
  for (DrawnMesh& mesh : dressed->meshes) face_outward(object, mesh);
  if (is_dog) groom(*dressed);
  return dressed;
}

}  // namespace nade::draw
