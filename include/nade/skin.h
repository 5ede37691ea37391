#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "nade/hand_mesh.h"

namespace nade {

/// Where palmar skin is. The thumb's ball is of its metacarpal and proximal bone; knuckles, heel
/// and hollow are of the other metacarpals. All that does not face the palm's side is back.
enum class SkinRegion : std::uint8_t { tip, finger, thenar, knuckles, heel, hollow, back };
inline constexpr std::size_t kSkinRegionCount = 7;

/// "tip", "finger", …
[[nodiscard]] std::string_view name_of(SkinRegion region);

/// What a hand mesh's skin is like, one element for each vertex.
struct SkinMap {
  std::vector<SkinRegion> region;
  /// How far flesh, and a palm that is drawn rigid and arched, give way there: metres, the mesh's
  /// own size.
  std::vector<double> flesh_m;
  /// A third of each triangle around it: square metres, bind pose.
  std::vector<double> area_m2;
};

/// Measures a hand mesh in its bind pose. The forearm's stump is back. Source of a fingertip's
/// depth: several studies of fingertips pressed at 1 N (about 2 mm); the others stand for flesh and
/// the palm's giving together.
[[nodiscard]] SkinMap measure_skin(const HandMesh& mesh);

}  // namespace nade
