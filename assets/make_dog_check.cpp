#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "make_dog_mesh.h"

namespace dog {
namespace {

using DirectedEdges = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>;

/// Whether the triangles around each vertex form one ring.
bool one_ring_each(const Mesh& mesh, const DirectedEdges& edges) {
  std::vector<std::uint32_t> incident(mesh.points.size(), 0);
  std::vector<std::uint32_t> any(mesh.points.size(), 0);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) {
      ++incident[v];
      any[v] = t;
    }
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (incident[v] == 0) return false;
    std::uint32_t t = any[v];
    std::uint32_t steps = 0;
    do {
      const auto& corners = mesh.triangles[t];
      const auto at =
          static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin());
      t = edges.at({v, corners[(at + 2) % 3]});
      ++steps;
    } while (t != any[v] && steps <= incident[v]);
    if (steps != incident[v]) return false;
  }
  return true;
}

std::size_t count_components(const Mesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  std::size_t components = mesh.points.size();
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = root(t[i]);
      const std::uint32_t b = root(t[(i + 1) % 3]);
      if (a == b) continue;
      parent[a] = b;
      --components;
    }
  return components;
}

double smallest_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto angle = [](const Vec3& u, const Vec3& v) {
    return std::atan2(u.cross(v).norm(), u.dot(v)) * 180.0 / std::numbers::pi;
  };
  return std::min({angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c)});
}

}  // namespace

std::optional<std::string> topology_defect(const Mesh& mesh) {
  DirectedEdges edges;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      if (!edges.try_emplace({mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]}, t).second)
        return "an edge has two triangles on the same side";
  for (const auto& [ends, triangle] : edges)
    if (!edges.contains({ends.second, ends.first})) return "it has a hole";
  if (!one_ring_each(mesh, edges)) return "a vertex joins separate sheets, or none";
  const std::size_t components = count_components(mesh);
  if (components != 1) return "expected one connected piece, found " + std::to_string(components);
  const auto euler = static_cast<long>(mesh.points.size() + mesh.triangles.size()) -
                     static_cast<long>(edges.size() / 2);
  if (euler != 2)
    return "expected Euler characteristic 2, no handles, found " + std::to_string(euler);
  return std::nullopt;
}

Quality measure_quality(const Body& body, const Mesh& mesh) {
  Quality quality{};
  quality.worst_alignment = 1.0;
  std::vector<double> angles;
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.points[t[0]];
    const Vec3& b = mesh.points[t[1]];
    const Vec3& c = mesh.points[t[2]];
    angles.push_back(smallest_angle(a, b, c));
    quality.volume += a.dot(b.cross(c)) / 6.0;
    const Vec3 normal = (b - a).cross(c - a).normalized();
    const Vec3 slope = body.sample((a + b + c) / 3.0).gradient.normalized();
    quality.worst_alignment = std::min(quality.worst_alignment, normal.dot(slope));
  }
  std::sort(angles.begin(), angles.end());
  quality.smallest_angle_deg = angles.front();
  quality.smallest_angle_p01_deg = angles[angles.size() / 100];
  quality.smallest_angle_p50_deg = angles[angles.size() / 2];
  for (const Vec3& point : mesh.points) {
    const FieldSample field = body.sample(point);
    const double miss = std::abs(field.distance) / std::max(field.gradient.norm(), 1e-3);
    quality.largest_miss = std::max(quality.largest_miss, miss);
  }
  return quality;
}

}  // namespace dog
