#include <cmath>
#include <map>

#include "object_look.h"
#include "vertex_normals.h"

// Based on: Thürmer, Wüthrich. Computing Vertex Normals from Polygonal Facets. 1998.

namespace nade::draw {
namespace {

using Vec3f = Eigen::Vector3f;

struct Corner {
  std::size_t triangle;
  Vec3f weighted;  ///< the face's unit normal times the angle here
};

Vec3f unit_or_zero(const Vec3f& v) {
  const float length = v.norm();
  return length > 0.0F ? Vec3f(v / length) : Vec3f(Vec3f::Zero());
}

/// One corner of a triangle becomes a vertex of its own.
DrawnMesh torn_apart(const DrawnMesh& mesh) {
  DrawnMesh apart;
  apart.material = mesh.material;
  apart.texture = mesh.texture;
  for (const auto& triangle : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(apart.positions.size());
    apart.triangles.push_back({first, first + 1, first + 2});
    for (const std::uint32_t vertex : triangle) {
      apart.positions.push_back(mesh.positions[vertex]);
      if (!mesh.colors.empty()) apart.colors.push_back(mesh.colors[vertex]);
      if (!mesh.texcoords.empty()) apart.texcoords.push_back(mesh.texcoords[vertex]);
      if (!mesh.sources.empty()) apart.sources.push_back(mesh.sources[vertex]);
    }
  }
  return apart;
}

}  // namespace

void compute_creased_normals(DrawnMesh& mesh) {
  const float least_cosine = std::cos(40.0F * static_cast<float>(kDegree));
  mesh = torn_apart(mesh);
  std::vector<Vec3f> face(mesh.triangles.size());
  std::map<Vec3f, std::vector<Corner>, ByPlace> corners;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3f* const p = &mesh.positions[3 * t];
    face[t] = unit_or_zero((p[1] - p[0]).cross(p[2] - p[0]));
    for (std::size_t k = 0; k < 3; ++k) {
      const float angle = angle_between(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
      corners[p[k]].push_back({t, angle * face[t]});
    }
  }
  mesh.normals.assign(mesh.positions.size(), Vec3f::UnitY());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3f sum = Vec3f::Zero();
      for (const Corner& corner : corners[mesh.positions[3 * t + k]]) {
        if (face[t].dot(face[corner.triangle]) >= least_cosine) sum += corner.weighted;
      }
      if (sum.norm() > 0.0F) mesh.normals[3 * t + k] = sum.normalized();
    }
  }
}

}  // namespace nade::draw
