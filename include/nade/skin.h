#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "nade/hand_mesh.h"

namespace nade {

/// Where on the hand a piece of skin is. All but `back` face the palmar side.
enum class SkinRegion : std::uint8_t {
  tip,       ///< the last phalanx of a digit
  finger,    ///< the other phalanges of a finger
  thenar,    ///< the thumb's metacarpal and proximal bone
  knuckles,  ///< the palm beside the fingers' roots
  heel,      ///< the palm beside the wrist and along the little finger's side
  hollow,    ///< the rest of the palm
  back,      ///< all other skin, and the forearm's stump
};
inline constexpr std::size_t kSkinRegionCount = 7;

/// "tip", "finger", "thenar", …
[[nodiscard]] std::string_view name_of(SkinRegion region);

/// What the skin of a hand mesh is like, by vertex of the mesh.
struct SkinMap {
  std::vector<SkinRegion> region;
  /// How far the skin may be pushed in: the flesh, and the giving of a palm that is drawn rigid.
  /// Metres, alike for hands of any size; the same for vertices at one place.
  std::vector<double> flesh_depth_m;
  /// A third of each triangle at the vertex, square metres, the mesh's own size.
  std::vector<double> area_m2;

  [[nodiscard]] bool is_palmar(std::size_t vertex) const {
    return region[vertex] != SkinRegion::back;
  }
};

/// Measured on the mesh in its bind pose. Palmar is what faces the palmar axis (-Y) of the bone
/// that weighs most on it within 60 degrees; on the thumb's metacarpal and proximal bone the middle
/// metacarpal's axis counts as well. The flesh is deepest there and thins out to 0.5 mm where the
/// skin faces sideways.
[[nodiscard]] SkinMap measure_skin(const HandMesh& mesh);

}  // namespace nade
