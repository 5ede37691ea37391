#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "nade/hand_mesh.h"

namespace nade {

/// What each joint weighs on a vertex; by index_of(Joint).
using JointWeights = std::array<double, kJointCount>;
[[nodiscard]] JointWeights weights_of(const HandMesh& mesh, std::size_t vertex);
/// The joint that weighs most.
[[nodiscard]] std::size_t heaviest(const JointWeights& weights);

/// The axis that palmar skin of a bone faces, with such a normal: the bone's own; of the thumb's
/// metacarpal and proximal bone that or the palm's, whichever is nearer.
[[nodiscard]] Vec3 palmar_axis(const HandMesh& mesh, Joint bone, const Vec3& normal);

/// Splits vertices so that none is farther than `widest_m` from the first of its piece: each next
/// piece starts at the vertex that is farthest from all firsts.
[[nodiscard]] std::vector<std::vector<std::size_t>> split_skin(
    const HandMesh& mesh, const std::vector<std::size_t>& vertices, double widest_m);

}  // namespace nade
