#include <algorithm>
#include <bit>

#include "mesh_topology.h"

namespace nade::detail {
namespace {

using Eigen::Vector3f;

constexpr std::uint32_t kEmpty = 0xffffffff;

std::uint64_t mix(std::uint64_t x) {
  // The finaliser of MurmurHash3 (public domain constants).
  x ^= x >> 33;
  x *= 0xff51afd7ed558ccdULL;
  x ^= x >> 33;
  x *= 0xc4ceb9fe1a85ec53ULL;
  return x ^ (x >> 33);
}

std::uint64_t hash3(const std::array<std::uint32_t, 3>& key) {
  return mix(mix(std::uint64_t{key[0]} << 32 | key[1]) + key[2]);
}

/// Numbers distinct triples in the order of first appearance.
class TripleIndex {
 public:
  explicit TripleIndex(std::size_t count) : slots_(std::bit_ceil(2 * count + 2), kEmpty) {
    keys_.reserve(count);
  }
  struct Entry {
    std::uint32_t index;
    bool is_new;
  };
  Entry insert(const std::array<std::uint32_t, 3>& key) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hash3(key) & mask;; slot = (slot + 1) & mask) {
      if (slots_[slot] == kEmpty) {
        slots_[slot] = static_cast<std::uint32_t>(keys_.size());
        keys_.push_back(key);
        return {slots_[slot], true};
      }
      if (keys_[slots_[slot]] == key) return {slots_[slot], false};
    }
  }

 private:
  std::vector<std::uint32_t> slots_;
  std::vector<std::array<std::uint32_t, 3>> keys_;
};

std::array<std::uint32_t, 3> bits_of(const Vector3f& position) {
  // Adding zero makes -0 the same as 0.
  return {std::bit_cast<std::uint32_t>(position.x() + 0.0F),
          std::bit_cast<std::uint32_t>(position.y() + 0.0F),
          std::bit_cast<std::uint32_t>(position.z() + 0.0F)};
}

/// Without area as far as a normal can be told: its height is lost in the rounding of its sides.
bool is_degenerate(const WeldedMesh& mesh, const Corners& corners) {
  if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return true;
  const Eigen::Vector3d a = mesh.vertices[corners[0]].cast<double>();
  const Eigen::Vector3d b = mesh.vertices[corners[1]].cast<double>();
  const Eigen::Vector3d c = mesh.vertices[corners[2]].cast<double>();
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  constexpr double kThinnest = 1e-10;
  return !((b - a).cross(c - a).norm() > kThinnest * longest);
}

}  // namespace

WeldedMesh weld(const TriangleSoup& soup, MeshReport& report) {
  WeldedMesh mesh;
  std::vector<std::uint32_t> welded(soup.vertices.size());
  TripleIndex positions(soup.vertices.size());
  for (std::uint32_t i = 0; i < soup.vertices.size(); ++i) {
    const auto entry = positions.insert(bits_of(soup.vertices[i]));
    welded[i] = entry.index;
    if (!entry.is_new) continue;
    mesh.source.push_back(i);
    mesh.vertices.push_back(soup.vertices[i]);
  }
  mesh.triangles.reserve(soup.triangles.size());
  TripleIndex seen(soup.triangles.size());
  for (const Corners& corners : soup.triangles) {
    const Corners triangle{welded[corners[0]], welded[corners[1]], welded[corners[2]]};
    if (is_degenerate(mesh, triangle)) {
      ++report.triangles_degenerate;
      continue;
    }
    Corners sorted = triangle;
    std::sort(sorted.begin(), sorted.end());
    if (!seen.insert(sorted).is_new) {
      ++report.triangles_duplicate;
      continue;
    }
    mesh.triangles.push_back(triangle);
  }
  report.triangles_used = mesh.triangles.size();
  return mesh;
}

void reorder(WeldedMesh& mesh, std::span<const std::uint32_t> order) {
  std::vector<std::uint32_t> place(mesh.vertices.size(), kEmpty);
  WeldedMesh sorted;
  sorted.source.reserve(mesh.source.size());
  sorted.vertices.reserve(mesh.vertices.size());
  sorted.triangles.reserve(mesh.triangles.size());
  for (const std::uint32_t triangle : order) {
    Corners corners = mesh.triangles[triangle];
    for (std::uint32_t& vertex : corners) {
      if (place[vertex] == kEmpty) {
        place[vertex] = static_cast<std::uint32_t>(sorted.vertices.size());
        sorted.source.push_back(mesh.source[vertex]);
        sorted.vertices.push_back(mesh.vertices[vertex]);
      }
      vertex = place[vertex];
    }
    sorted.triangles.push_back(corners);
  }
  mesh = std::move(sorted);
}

}  // namespace nade::detail
