#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "make_dog_mesh.h"

// Based on: Akio Doi, Akio Koide. An Efficient Method of Triangulating Equi-Valued Surfaces by
// Using Tetrahedral Cells. 1991.

namespace dog {
namespace {

constexpr std::uint32_t kBlock = 4;  // lattice points a block side, decided together

using Cell = std::array<std::uint32_t, 3>;

class Lattice {
 public:
  Lattice(const Body& body, double spacing) : spacing_(spacing) {
    const Box box = body.bounds();
    // Off the mid plane, so that no lattice point lies on it.
    origin_ = box.min().array() - 2.0 * spacing - Eigen::Array3d(0.0, 0.0, 0.37 * spacing);
    for (int axis = 0; axis < 3; ++axis) {
      const double length = box.max()[axis] + 3.0 * spacing - origin_[axis];
      const auto blocks = static_cast<std::uint32_t>(std::ceil(length / (spacing * kBlock)));
      size_[static_cast<std::size_t>(axis)] = blocks * kBlock;
    }
    values_.resize(std::size_t{size_[0]} * size_[1] * size_[2]);
    for (std::uint32_t x = 0; x < size_[0]; x += kBlock)
      for (std::uint32_t y = 0; y < size_[1]; y += kBlock)
        for (std::uint32_t z = 0; z < size_[2]; z += kBlock) fill_block(body, {x, y, z});
  }

  [[nodiscard]] std::uint32_t index(const Cell& c) const {
    return (c[0] * size_[1] + c[1]) * size_[2] + c[2];
  }
  [[nodiscard]] Vec3 point(const Cell& c) const {
    return origin_ + spacing_ * Vec3(c[0], c[1], c[2]);
  }
  [[nodiscard]] double value(const Cell& c) const { return values_[index(c)]; }
  [[nodiscard]] const Cell& size() const { return size_; }

 private:
  void fill_block(const Body& body, const Cell& first) {
    // Evaluates a whole block only where the surface may pass through it or its neighbours.
    const double half = 0.5 * (kBlock - 1) * spacing_;
    const double middle = body.distance(point(first) + Vec3::Constant(half));
    const bool near = std::abs(middle) < 2.5 * (half + spacing_) * std::sqrt(3.0);
    for (std::uint32_t x = first[0]; x < first[0] + kBlock; ++x)
      for (std::uint32_t y = first[1]; y < first[1] + kBlock; ++y)
        for (std::uint32_t z = first[2]; z < first[2] + kBlock; ++z) {
          const double value = near ? body.distance(point({x, y, z})) : middle;
          values_[index({x, y, z})] = value == 0.0 ? 1e-12 : value;
        }
  }

  double spacing_;
  Vec3 origin_;
  Cell size_{};
  std::vector<double> values_;
};

class Extraction {
 public:
  explicit Extraction(const Lattice& lattice) : lattice_(lattice) {}

  void add_cube(const Cell& cell) {
    bool inside = false;
    bool outside = false;
    for (std::uint32_t corner = 0; corner < 8; ++corner)
      (lattice_.value(offset(cell, corner)) < 0.0 ? inside : outside) = true;
    if (!inside || !outside) return;
    // Six tetrahedra around the main diagonal, one for each order of the axes: neighbouring cubes
    // then cut their shared face the same way.
    static constexpr std::array<std::array<std::uint32_t, 2>, 6> kOrders{
        {{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}}};
    for (const auto& order : kOrders)
      add_tetrahedron(
          {offset(cell, 0), offset(cell, order[0]), offset(cell, order[1]), offset(cell, 7)});
  }

  Mesh mesh;

 private:
  static Cell offset(const Cell& cell, std::uint32_t corner) {
    return {cell[0] + (corner & 1U), cell[1] + ((corner >> 1U) & 1U), cell[2] + (corner >> 2U)};
  }

  std::uint32_t vertex(const Cell& a, const Cell& b) {
    const std::uint64_t ia = lattice_.index(a);
    const std::uint64_t ib = lattice_.index(b);
    const std::uint64_t key = (std::min(ia, ib) << 32U) | std::max(ia, ib);
    const auto [place, added] =
        vertices_.try_emplace(key, static_cast<std::uint32_t>(mesh.points.size()));
    if (added) {
      const double fa = lattice_.value(a);
      const double fb = lattice_.value(b);
      const double share = std::clamp(fa / (fa - fb), 0.02, 0.98);
      mesh.points.push_back(lattice_.point(a) + share * (lattice_.point(b) - lattice_.point(a)));
    }
    return place->second;
  }

  void add_tetrahedron(const std::array<Cell, 4>& corners) {
    std::vector<Cell> in;
    std::vector<Cell> out;
    for (const Cell& corner : corners) (lattice_.value(corner) < 0.0 ? in : out).push_back(corner);
    if (in.size() == 1) {
      add_triangle(in, out, {vertex(in[0], out[0]), vertex(in[0], out[1]), vertex(in[0], out[2])});
    } else if (in.size() == 3) {
      add_triangle(in, out, {vertex(in[0], out[0]), vertex(in[1], out[0]), vertex(in[2], out[0])});
    } else if (in.size() == 2) {
      const std::uint32_t a = vertex(in[0], out[0]);
      const std::uint32_t b = vertex(in[0], out[1]);
      const std::uint32_t c = vertex(in[1], out[1]);
      const std::uint32_t d = vertex(in[1], out[0]);
      add_triangle(in, out, {a, b, c});
      add_triangle(in, out, {a, c, d});
    }
  }

  void add_triangle(const std::vector<Cell>& in, const std::vector<Cell>& out,
                    std::array<std::uint32_t, 3> t) {
    // Turned by the tetrahedron's own shape, which a thin triangle cannot confuse.
    const auto middle = [&](const std::vector<Cell>& cells) {
      Vec3 sum = Vec3::Zero();
      for (const Cell& cell : cells) sum += lattice_.point(cell);
      return Vec3(sum / static_cast<double>(cells.size()));
    };
    const Vec3 normal =
        (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]);
    if (normal.dot(middle(out) - middle(in)) < 0.0) std::swap(t[1], t[2]);
    mesh.triangles.push_back(t);
  }

  const Lattice& lattice_;
  std::unordered_map<std::uint64_t, std::uint32_t> vertices_;
};

}  // namespace

Mesh extract_surface(const Body& body, double spacing) {
  const Lattice lattice(body, spacing);
  Extraction extraction(lattice);
  const Cell& size = lattice.size();
  for (std::uint32_t x = 0; x + 1 < size[0]; ++x)
    for (std::uint32_t y = 0; y + 1 < size[1]; ++y)
      for (std::uint32_t z = 0; z + 1 < size[2]; ++z) extraction.add_cube({x, y, z});
  return extraction.mesh;
}

}  // namespace dog
