#include "skin_pieces.h"

#include <algorithm>
#include <limits>

namespace nade {

JointWeights weights_of(const HandMesh& mesh, std::size_t vertex) {
  JointWeights weights{};
  for (std::size_t k = 0; k < 4; ++k) {
    weights[mesh.bones[vertex][k]] += static_cast<double>(mesh.weights[vertex][k]);
  }
  return weights;
}

std::size_t heaviest(const JointWeights& weights) {
  return static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) -
                                  weights.begin());
}

Vec3 palmar_axis(const HandMesh& mesh, Joint bone, const Vec3& normal) {
  const Vec3 own = mesh.bind[bone].rotation * -Vec3::UnitY();
  if (bone != Joint::thumb_metacarpal && bone != Joint::thumb_proximal) return own;
  const Vec3 palm = mesh.bind[Joint::middle_metacarpal].rotation * -Vec3::UnitY();
  return palm.dot(normal) > own.dot(normal) ? palm : own;
}

std::vector<std::vector<std::size_t>> split_skin(const HandMesh& mesh,
                                                 const std::vector<std::size_t>& vertices,
                                                 double widest_m) {
  const auto at = [&mesh](std::size_t i) -> Vec3 { return mesh.vertices[i].cast<double>(); };
  std::vector<std::vector<std::size_t>> pieces;
  std::vector<double> distance(vertices.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> owner(vertices.size(), 0);
  std::size_t first = 0;
  do {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const double to_first = (at(vertices[i]) - at(vertices[first])).norm();
      if (to_first >= distance[i]) continue;
      distance[i] = to_first;
      owner[i] = pieces.size();
    }
    pieces.emplace_back();
    first = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) -
                                     distance.begin());
  } while (distance[first] > widest_m);
  for (std::size_t i = 0; i < vertices.size(); ++i) pieces[owner[i]].push_back(vertices[i]);
  return pieces;
}

}  // namespace nade
