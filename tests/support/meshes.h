#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nade/mesh.h"
#include "support/files.h"

namespace nade::test {

using Vec3f = Eigen::Vector3f;

/// Each triangle in four, `times` times; the surface stays the same.
inline TriangleSoup subdivided(TriangleSoup soup, int times = 1) {
  for (; times > 0; --times) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto key = std::minmax(a, b);
      const auto [place, is_new] = middles.try_emplace(
          {key.first, key.second}, static_cast<std::uint32_t>(soup.vertices.size()));
      if (is_new) soup.vertices.emplace_back(0.5F * (soup.vertices[a] + soup.vertices[b]));
      return place->second;
    };
    std::vector<std::array<std::uint32_t, 3>> triangles;
    triangles.reserve(4 * soup.triangles.size());
    for (const auto& [a, b, c] : soup.triangles) {
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      triangles.insert(triangles.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    soup.triangles = std::move(triangles);
  }
  return soup;
}

/// A box about the origin, 12 triangles.
inline TriangleSoup box_mesh(const Vec3f& half_size) {
  TriangleSoup soup;
  for (int i = 0; i < 8; ++i) {
    soup.vertices.emplace_back((i & 1) != 0 ? half_size.x() : -half_size.x(),
                               (i & 2) != 0 ? half_size.y() : -half_size.y(),
                               (i & 4) != 0 ? half_size.z() : -half_size.z());
  }
  soup.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return soup;
}

/// A box about the origin whose edges are rounded: what lies within `radius` of a smaller one.
inline TriangleSoup rounded_box_mesh(const Vec3f& half_size, float radius) {
  constexpr int kSteps = 6;  // across an edge's half
  constexpr int kTicks = 2 * kSteps + 2;
  const auto tick = [radius](int i, float half) {
    const float in = radius * static_cast<float>(std::min(i, kTicks - 1 - i)) / kSteps;
    return 2 * i < kTicks ? in - half : half - in;
  };
  const Vec3f core = half_size - Vec3f::Constant(radius);
  TriangleSoup soup;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (const float side : {-1.0F, 1.0F}) {
      const auto first = static_cast<std::uint32_t>(soup.vertices.size());
      for (int i = 0; i < kTicks; ++i) {
        for (int j = 0; j < kTicks; ++j) {
          Vec3f square;
          square[axis] = side * half_size[axis];
          square[u] = tick(i, half_size[u]);
          square[v] = tick(j, half_size[v]);
          const Vec3f inner = square.cwiseMin(core).cwiseMax(-core);
          soup.vertices.push_back(inner + radius * (square - inner).normalized());
        }
      }
      for (int i = 0; i + 1 < kTicks; ++i) {
        for (int j = 0; j + 1 < kTicks; ++j) {
          const auto a = first + static_cast<std::uint32_t>(i * kTicks + j);
          const std::array<std::uint32_t, 4> at{a, a + kTicks, a + kTicks + 1, a + 1};
          const bool up = side > 0.0F;
          soup.triangles.push_back({at[0], up ? at[1] : at[2], up ? at[2] : at[1]});
          soup.triangles.push_back({at[0], up ? at[2] : at[3], up ? at[3] : at[2]});
        }
      }
    }
  }
  return soup;
}

/// An icosahedron's triangles in four, `times` times, on the sphere: 20 x 4^times triangles.
inline TriangleSoup icosphere(float radius, int times) {
  const float g = std::numbers::phi_v<float>;
  TriangleSoup soup;
  soup.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  soup.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  soup = subdivided(std::move(soup), times);
  for (Vec3f& vertex : soup.vertices) vertex = radius * vertex.normalized();
  return soup;
}

/// A sphere of rings and sectors: 2 x sectors x (rings - 1) triangles. 200 x 201: 80,000.
inline TriangleSoup uv_sphere(float radius, std::uint32_t sectors, std::uint32_t rings) {
  TriangleSoup soup;
  soup.vertices.emplace_back(0.0F, radius, 0.0F);
  for (std::uint32_t ring = 1; ring < rings; ++ring) {
    const double polar = std::numbers::pi * ring / rings;
    for (std::uint32_t sector = 0; sector < sectors; ++sector) {
      const double turn = 2.0 * std::numbers::pi * sector / sectors;
      soup.vertices.emplace_back(
          (static_cast<double>(radius) * Vec3(std::sin(polar) * std::sin(turn), std::cos(polar),
                                              std::sin(polar) * std::cos(turn)))
              .cast<float>());
    }
  }
  soup.vertices.emplace_back(0.0F, -radius, 0.0F);
  const auto last = static_cast<std::uint32_t>(soup.vertices.size() - 1);
  const auto at = [&](std::uint32_t ring, std::uint32_t sector) {
    return 1 + (ring - 1) * sectors + sector % sectors;
  };
  for (std::uint32_t sector = 0; sector < sectors; ++sector) {
    soup.triangles.push_back({0, at(1, sector), at(1, sector + 1)});
    for (std::uint32_t ring = 1; ring + 1 < rings; ++ring) {
      soup.triangles.push_back({at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1)});
      soup.triangles.push_back({at(ring, sector), at(ring + 1, sector + 1), at(ring, sector + 1)});
    }
    soup.triangles.push_back({at(rings - 1, sector), last, at(rings - 1, sector + 1)});
  }
  return soup;
}

/// A sphere with hills and dales of a tenth of its radius, star-shaped.
inline TriangleSoup bumpy_sphere(float radius, std::uint32_t sectors, std::uint32_t rings) {
  TriangleSoup soup = uv_sphere(radius, sectors, rings);
  for (Vec3f& vertex : soup.vertices) {
    const Vec3f at = vertex / radius;
    vertex *= 1.0F + 0.1F * std::sin(7.0F * at.x()) * std::cos(5.0F * at.y() + 3.0F * at.z());
  }
  return soup;
}

/// A square in y = 0 about the origin, facing up, of `cells` x `cells` squares.
inline TriangleSoup grid_mesh(float half_size, std::uint32_t cells) {
  TriangleSoup soup;
  const auto place = [&](std::uint32_t i) {
    return half_size * (2.0F * static_cast<float>(i) / static_cast<float>(cells) - 1.0F);
  };
  for (std::uint32_t z = 0; z <= cells; ++z) {
    for (std::uint32_t x = 0; x <= cells; ++x) soup.vertices.emplace_back(place(x), 0.0F, place(z));
  }
  for (std::uint32_t z = 0; z < cells; ++z) {
    for (std::uint32_t x = 0; x < cells; ++x) {
      const std::uint32_t a = z * (cells + 1) + x;
      const std::uint32_t b = a + cells + 1;
      soup.triangles.push_back({a, b, b + 1});
      soup.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return soup;
}

/// Both meshes as one.
inline TriangleSoup joined(TriangleSoup a, const TriangleSoup& b) {
  const auto offset = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles) {
    a.triangles.push_back({i + offset, j + offset, k + offset});
  }
  return a;
}

inline TriangleSoup turned_inside_out(TriangleSoup soup) {
  for (auto& triangle : soup.triangles) std::swap(triangle[1], triangle[2]);
  return soup;
}

inline TriangleSoup shifted(TriangleSoup soup, const Vec3f& by) {
  for (Vec3f& vertex : soup.vertices) vertex += by;
  return soup;
}

/// A box whose top is at y = 0.
inline std::unique_ptr<MeshSurface> block(const Vec3f& half_size) {
  const Vec3f middle(0.0F, -half_size.y(), 0.0F);
  return MeshSurface::build(shifted(box_mesh(half_size), middle), "block").value();
}

/// Its top at y = 0.
inline std::unique_ptr<MeshSurface> table() { return block({0.2F, 0.02F, 0.15F}); }

inline Placement upright(const Vec3& position) { return {{position, Quat::Identity()}, 1.0}; }

/// The numbers of one list of lists, `exports.NAME=[[a,b,c],…]`.
inline std::vector<std::array<double, 3>> exported_triples(const std::string& text,
                                                           const std::string& name) {
  std::vector<std::array<double, 3>> triples;
  std::size_t at = text.find("exports." + name);
  if (at == std::string::npos) return triples;
  at = text.find('[', at) + 1;
  while (at < text.size() && text[at] != ']') {
    std::array<double, 3> triple{};
    for (double& number : triple) {
      while (at < text.size() && (text[at] == '[' || text[at] == ',')) ++at;
      char* end = nullptr;
      number = std::strtod(text.c_str() + at, &end);
      at = static_cast<std::size_t>(end - text.c_str());
    }
    triples.push_back(triple);
    at = text.find(']', at);
    if (at != std::string::npos) ++at;
    while (at < text.size() && (text[at] == ',' || text[at] == ' ' || text[at] == '\n')) ++at;
  }
  return triples;
}

/// The npm package bunny's index.js, scaled so that the bunny is `height_m` high.
inline std::optional<TriangleSoup> load_bunny(const std::string& path, float height_m = 0.25F) {
  const std::string text = read_file(path);
  if (text.empty()) return std::nullopt;
  TriangleSoup soup;
  Eigen::AlignedBox3f box;
  for (const auto& [x, y, z] : exported_triples(text, "positions")) {
    soup.vertices.emplace_back(Vec3(x, y, z).cast<float>());
    box.extend(soup.vertices.back());
  }
  for (const auto& [a, b, c] : exported_triples(text, "cells")) {
    soup.triangles.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                              static_cast<std::uint32_t>(c)});
  }
  if (soup.triangles.empty()) return std::nullopt;
  const Vec3f centre = box.center();
  for (Vec3f& vertex : soup.vertices) {
    vertex = height_m / box.sizes().y() * (vertex - centre);
  }
  return soup;
}

/// The bunny that NADE_TEST_BUNNY, or else this build, names.
inline std::optional<TriangleSoup> find_bunny() {
  if (const char* path = std::getenv("NADE_TEST_BUNNY")) return load_bunny(path);
#if defined(NADE_TEST_BUNNY)
  return load_bunny(NADE_TEST_BUNNY);
#else
  return std::nullopt;
#endif
}

}  // namespace nade::test
