#include "nade/flesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "generic_hand.h"
#include "support/hand_checks.h"
#include "support/pressed_hand.h"

namespace nade {
namespace {

/// Each triangle in four, and vertices between every two that share an edge.
HandMesh finer(const HandMesh& mesh) {
  HandMesh result = mesh;
  result.triangles.clear();
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [found, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(result.vertices.size()));
    if (!is_new) return found->second;
    result.vertices.emplace_back(0.5F * (mesh.vertices[a] + mesh.vertices[b]));
    result.normals.emplace_back((mesh.normals[a] + mesh.normals[b]).normalized());
    result.bones.push_back(mesh.bones[a]);
    result.weights.push_back(mesh.weights[a]);
    return found->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = middle(a, b);
    const std::uint32_t bc = middle(b, c);
    const std::uint32_t ca = middle(c, a);
    result.triangles.insert(result.triangles.end(),
                            {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return result;
}

/// With a row for every vertex there were too many: those left out let the hand sink in by 34 mm.
TEST(Flesh, AFineMeshIsThinned) {
  NADE_TEST_GENERIC_HAND(mesh, Handedness::right);
  CorrectorOptions options = test::settling();
  const auto flesh = std::make_shared<HandFlesh>(measure_flesh(finer(finer(mesh))));
  EXPECT_LE(flesh->skin.size(), kMostSkinPoints);
  EXPECT_GT(flesh->skin.size(), kMostSkinPoints / 2);
  options.flesh[index_of(Handedness::right)] = flesh;
  HandCorrector corrector(options);
  for (int i = 0; i < 3; ++i) {
    const HandPose tracked = test::pressed_hand(0.02);
    const HandPose& drawn = corrector.update(tracked, test::plane(), i * test::kFrame_ns).pose;
    EXPECT_GT(test::least_room(drawn, test::plane()), -0.0025) << "frame " << i;
  }
}

}  // namespace
}  // namespace nade
