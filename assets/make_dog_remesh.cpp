#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "make_dog_mesh.h"

// Based on: Mario Botsch, Leif Kobbelt. A Remeshing Approach to Multiresolution Modeling. 2004.
// (split, collapse, flip, relax; here with an edge length that varies and with vertices that go
// back to the exact surface instead of to the old mesh)

namespace dog {
namespace {

constexpr int kSizingPasses = 6;
constexpr int kSmoothingPasses = 6;
constexpr double kTooLong = 4.0 / 3.0;
constexpr double kTooShort = 4.0 / 5.0;

/// A closed triangle mesh as half edges: half edge 3 t + i runs from corner i of triangle t to the
/// next corner.
class HalfEdgeMesh {
 public:
  explicit HalfEdgeMesh(const Body& body, const Mesh& mesh) : body_(body), points_(mesh.points) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> by_ends;
    for (const auto& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        by_ends[{t[i], t[(i + 1) % 3]}] = static_cast<std::uint32_t>(start_.size());
        start_.push_back(t[i]);
      }
    twin_.resize(start_.size());
    out_.resize(points_.size());
    for (const auto& [ends, h] : by_ends) {
      twin_[h] = by_ends.at({ends.second, ends.first});
      out_[ends.first] = h;
    }
    alive_.assign(mesh.triangles.size(), true);
    vertex_alive_.assign(points_.size(), true);
    edge_.resize(points_.size());
    for (std::uint32_t v = 0; v < points_.size(); ++v) edge_[v] = body_.edge_length(points_[v]);
  }

  /// Halves long edges that are the longest of both their triangles: halving others first would
  /// make ever thinner triangles.
  void split_long() {
    for (std::uint32_t h = 0; h < start_.size(); ++h) {
      if (!is_edge(h)) continue;
      const double length = half_edge_length(h);
      const auto longest_of = [&](std::uint32_t side) {
        return half_edge_length(next(side)) <= length && half_edge_length(previous(side)) <= length;
      };
      if (length > kTooLong && longest_of(h) && longest_of(twin_[h])) split(h);
    }
  }

  void collapse_short() {
    for (std::uint32_t h = 0; h < start_.size(); ++h)
      if (is_edge(h) && half_edge_length(h) < kTooShort) try_collapse(h);
  }

  /// Turns edges so that vertices come nearer to six neighbours.
  void flip_to_even_valence() {
    std::vector<int> valence(points_.size(), 0);
    for (std::uint32_t h = 0; h < start_.size(); ++h)
      if (alive_[h / 3]) ++valence[start_[h]];
    const auto cost = [](int v) { return (v - 6) * (v - 6); };
    for (std::uint32_t h = 0; h < start_.size(); ++h) {
      if (!is_edge(h)) continue;
      const std::array<std::uint32_t, 4> v = {start_[h], end(h), apex(h), apex(twin_[h])};
      const int before =
          cost(valence[v[0]]) + cost(valence[v[1]]) + cost(valence[v[2]]) + cost(valence[v[3]]);
      const int after = cost(valence[v[0]] - 1) + cost(valence[v[1]] - 1) +
                        cost(valence[v[2]] + 1) + cost(valence[v[3]] + 1);
      if (after >= before || !may_flip(h)) continue;
      flip(h);
      --valence[v[0]];
      --valence[v[1]];
      ++valence[v[2]];
      ++valence[v[3]];
    }
  }

  /// Turns edges whose opposite angles sum to more than half a turn.
  void flip_to_delaunay() {
    for (int pass = 0; pass < 4; ++pass)
      for (std::uint32_t h = 0; h < start_.size(); ++h) {
        if (!is_edge(h)) continue;
        if (angle_at_apex(h) + angle_at_apex(twin_[h]) > std::acos(-1.0) + 1e-6 && may_flip(h))
          flip(h);
      }
  }

  /// Moves every vertex toward the middle of the triangles around it, then back to the surface.
  void relax(int projection_steps) {
    std::vector<Vec3> moved = points_;
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
      if (!vertex_alive_[v]) continue;
      Vec3 sum = Vec3::Zero();
      Vec3 normal = Vec3::Zero();
      double weights = 0.0;
      for_each_out(v, [&](std::uint32_t h) {
        const Vec3 area = corner_normal(h);
        const Vec3 middle = (points_[v] + points_[end(h)] + points_[apex(h)]) / 3.0;
        const double size = (edge_[v] + edge_[end(h)] + edge_[apex(h)]) / 3.0;
        const double weight = area.norm() / (size * size * size * size);
        sum += weight * middle;
        weights += weight;
        normal += area;
      });
      if (weights <= 0.0) continue;
      normal.normalize();
      Vec3 step = sum / weights - points_[v];
      step -= step.dot(normal) * normal;
      moved[v] = body_.project(points_[v] + step, projection_steps);
    }
    points_ = std::move(moved);
    for (std::uint32_t v = 0; v < points_.size(); ++v)
      if (vertex_alive_[v]) edge_[v] = body_.edge_length(points_[v]);
  }

  [[nodiscard]] Mesh compact() const {
    Mesh mesh;
    std::vector<std::uint32_t> name(points_.size());
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
      if (!vertex_alive_[v]) continue;
      name[v] = static_cast<std::uint32_t>(mesh.points.size());
      mesh.points.push_back(points_[v]);
    }
    for (std::uint32_t t = 0; t < alive_.size(); ++t)
      if (alive_[t])
        mesh.triangles.push_back(
            {name[start_[3 * t]], name[start_[3 * t + 1]], name[start_[3 * t + 2]]});
    return mesh;
  }

 private:
  static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::uint32_t previous(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  [[nodiscard]] std::uint32_t end(std::uint32_t h) const { return start_[next(h)]; }
  [[nodiscard]] std::uint32_t apex(std::uint32_t h) const { return start_[previous(h)]; }
  /// Whether `h` stands for its edge: each edge once.
  [[nodiscard]] bool is_edge(std::uint32_t h) const { return alive_[h / 3] && h < twin_[h]; }

  /// Length over the wanted length.
  [[nodiscard]] double half_edge_length(std::uint32_t h) const {
    const std::uint32_t a = start_[h], b = end(h);
    return (points_[a] - points_[b]).norm() * 2.0 / (edge_[a] + edge_[b]);
  }
  [[nodiscard]] Vec3 corner_normal(std::uint32_t h) const {
    return normal_of(points_[start_[h]], points_[end(h)], points_[apex(h)]);
  }
  static Vec3 normal_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b - a).cross(c - a);
  }
  [[nodiscard]] double angle_at_apex(std::uint32_t h) const {
    const Vec3 a = points_[start_[h]] - points_[apex(h)];
    const Vec3 b = points_[end(h)] - points_[apex(h)];
    return std::atan2(a.cross(b).norm(), a.dot(b));
  }

  template <class Visit>
  void for_each_out(std::uint32_t v, Visit visit) const {
    const std::uint32_t first = out_[v];
    std::uint32_t h = first;
    do {
      visit(h);
      h = twin_[previous(h)];
    } while (h != first);
  }
  [[nodiscard]] bool adjacent(std::uint32_t a, std::uint32_t b) const {
    bool found = false;
    for_each_out(a, [&](std::uint32_t h) { found = found || end(h) == b; });
    return found;
  }
  [[nodiscard]] int valence(std::uint32_t v) const {
    int count = 0;
    for_each_out(v, [&](std::uint32_t) { ++count; });
    return count;
  }

  void link(std::uint32_t a, std::uint32_t b) {
    twin_[a] = b;
    twin_[b] = a;
  }

  [[nodiscard]] bool may_flip(std::uint32_t h) const {
    const std::uint32_t a = start_[h], b = end(h), c = apex(h), d = apex(twin_[h]);
    if (valence(a) <= 4 || valence(b) <= 4 || adjacent(c, d)) return false;
    // The new triangles must face the way the old ones do.
    const Vec3 old = corner_normal(h).normalized() + corner_normal(twin_[h]).normalized();
    const Vec3 first = normal_of(points_[a], points_[d], points_[c]);
    const Vec3 second = normal_of(points_[d], points_[b], points_[c]);
    constexpr double kFacing = 0.7;
    return first.dot(old) > kFacing * first.norm() * old.norm() &&
           second.dot(old) > kFacing * second.norm() * old.norm();
  }

  void flip(std::uint32_t h) {
    const std::uint32_t o = twin_[h];
    const std::uint32_t hn = next(h), hp = previous(h), on = next(o), op = previous(o);
    const std::uint32_t a = start_[h], b = start_[o], c = start_[hp], d = start_[op];
    const std::uint32_t from_a = twin_[on], to_b = twin_[op], from_b = twin_[hn];
    start_[hn] = d;
    start_[o] = d;
    start_[on] = b;
    start_[op] = c;
    link(h, from_a);
    link(hn, op);
    link(o, to_b);
    link(on, from_b);
    out_[a] = h;
    out_[b] = on;
    out_[c] = hp;
    out_[d] = o;
  }

  void split(std::uint32_t h) {
    const std::uint32_t o = twin_[h];
    const std::uint32_t hn = next(h), hp = previous(h), op = previous(o);
    const std::uint32_t a = start_[h], b = start_[o], c = start_[hp], d = start_[op];
    const auto m = static_cast<std::uint32_t>(points_.size());
    points_.push_back(0.5 * (points_[a] + points_[b]));
    edge_.push_back(0.5 * (edge_[a] + edge_[b]));
    vertex_alive_.push_back(true);
    const auto n2 = static_cast<std::uint32_t>(start_.size());
    const std::uint32_t n3 = n2 + 3;
    const std::uint32_t from_b = twin_[hn], to_b = twin_[op];
    start_.insert(start_.end(), {m, b, c, b, m, d});
    twin_.resize(start_.size());
    alive_.insert(alive_.end(), {true, true});
    start_[hn] = m;
    start_[o] = m;
    link(n2, n3);
    link(n2 + 1, from_b);
    link(n2 + 2, hn);
    link(n3 + 2, to_b);
    link(n3 + 1, op);
    out_.push_back(hn);
    out_[b] = n2 + 1;
  }

  void try_collapse(std::uint32_t h) {
    const std::uint32_t o = twin_[h];
    const std::uint32_t a = start_[h], b = start_[o], c = apex(h), d = apex(o);
    if (valence(c) <= 4 || valence(d) <= 4 || valence(a) + valence(b) - 4 < 4) return;
    int shared = 0;
    for_each_out(a, [&](std::uint32_t out) { shared += adjacent(b, end(out)) ? 1 : 0; });
    if (shared != 2) return;
    const Vec3 middle = 0.5 * (points_[a] + points_[b]);
    bool allowed = true;
    const auto check = [&](std::uint32_t out) {
      const std::uint32_t p = end(out), q = apex(out);
      const double length = (points_[p] - middle).norm() * 2.0 / (edge_[p] + edge_[a]);
      allowed = allowed && length < kTooLong;
      if (p == a || p == b || q == a || q == b) return;
      const Vec3 before = corner_normal(out);
      const Vec3 after = normal_of(middle, points_[p], points_[q]);
      allowed = allowed && after.dot(before) > 0.6 * after.norm() * before.norm();
    };
    for_each_out(a, check);
    for_each_out(b, check);
    if (allowed) collapse(h, middle);
  }

  void collapse(std::uint32_t h, const Vec3& to) {
    const std::uint32_t o = twin_[h];
    const std::uint32_t hn = next(h), hp = previous(h), on = next(o), op = previous(o);
    const std::uint32_t a = start_[h], b = start_[o], c = start_[hp], d = start_[op];
    std::vector<std::uint32_t> around;
    for_each_out(a, [&](std::uint32_t out) { around.push_back(out); });
    for (const std::uint32_t out : around) start_[out] = b;
    const std::uint32_t to_c = twin_[hp], from_c = twin_[hn];
    const std::uint32_t from_d = twin_[on], to_d = twin_[op];
    link(from_c, to_c);
    link(from_d, to_d);
    out_[b] = to_c;
    out_[c] = from_c;
    out_[d] = from_d;
    points_[b] = to;
    alive_[h / 3] = false;
    alive_[o / 3] = false;
    vertex_alive_[a] = false;
  }

  const Body& body_;
  std::vector<Vec3> points_;
  std::vector<double> edge_;  ///< wanted edge length at each vertex
  std::vector<std::uint32_t> start_;
  std::vector<std::uint32_t> twin_;
  std::vector<std::uint32_t> out_;  ///< one half edge out of each vertex
  std::vector<bool> alive_;         ///< by triangle
  std::vector<bool> vertex_alive_;
};

}  // namespace

Mesh remesh(const Body& body, const Mesh& rough) {
  HalfEdgeMesh mesh(body, rough);
  for (int pass = 0; pass < kSizingPasses; ++pass) {
    mesh.split_long();
    mesh.collapse_short();
    mesh.flip_to_even_valence();
    mesh.relax(1);
  }
  for (int pass = 0; pass < kSmoothingPasses; ++pass) {
    mesh.flip_to_delaunay();
    mesh.relax(pass + 1 == kSmoothingPasses ? 8 : 1);
  }
  return mesh.compact();
}

}  // namespace dog
