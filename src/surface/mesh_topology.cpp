#include "mesh_topology.h"

#include <algorithm>
#include <utility>

namespace nade::detail {
namespace {

using Eigen::Vector3d;

/// A mesh whose vector areas add up to more than this share of its area faces one way: a sheet.
/// A flat sheet has 1, a half sphere 0.5, a box without lid 0.2, anything closed 0.
constexpr double kSheetShare = 0.25;

struct HalfEdge {
  std::uint32_t other_end;  ///< the higher vertex; the lower is the bucket
  std::uint32_t triangle;
  std::uint8_t edge;
  bool ascending;  ///< the triangle runs from the lower to the higher vertex
};

/// What lies across the edges, and whether it is wound alike.
struct Adjacency {
  std::vector<Corners> neighbours;
  std::vector<std::array<bool, 3>> alike;
};

Adjacency find_neighbours(const WeldedMesh& mesh, MeshReport& report) {
  std::vector<std::uint32_t> begin(mesh.vertices.size() + 1, 0);
  const auto ends = [&](std::uint32_t triangle, std::uint8_t edge) {
    const Corners& corners = mesh.triangles[triangle];
    return std::pair(corners[edge], corners[edge == 2 ? 0 : edge + 1U]);
  };
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  for (std::uint32_t t = 0; t < count; ++t) {
    for (std::uint8_t e = 0; e < 3; ++e) {
      const auto [from, to] = ends(t, e);
      ++begin[std::min(from, to) + 1];
    }
  }
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  std::vector<HalfEdge> edges(std::size_t{3} * count);
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::uint32_t t = 0; t < count; ++t) {
    for (std::uint8_t e = 0; e < 3; ++e) {
      const auto [from, to] = ends(t, e);
      edges[next[std::min(from, to)]++] = {std::max(from, to), t, e, from < to};
    }
  }
  Adjacency result;
  result.neighbours.resize(count);
  result.alike.resize(count);
  for (std::size_t vertex = 0; vertex < mesh.vertices.size(); ++vertex) {
    HalfEdge* const first = edges.data() + begin[vertex];
    HalfEdge* const last = edges.data() + begin[vertex + 1];
    std::sort(first, last, [](const HalfEdge& a, const HalfEdge& b) {
      return std::pair(a.other_end, a.triangle) < std::pair(b.other_end, b.triangle);
    });
    for (HalfEdge* edge = first; edge != last;) {
      HalfEdge* const end = std::find_if(
          edge, last, [&](const HalfEdge& other) { return other.other_end != edge->other_end; });
      if (end - edge == 2) {
        const HalfEdge& a = edge[0];
        const HalfEdge& b = edge[1];
        result.neighbours[a.triangle][a.edge] = b.triangle;
        result.neighbours[b.triangle][b.edge] = a.triangle;
        result.alike[a.triangle][a.edge] = a.ascending != b.ascending;
        result.alike[b.triangle][b.edge] = a.ascending != b.ascending;
      } else {
        const bool alone = end - edge == 1;
        ++(alone ? report.border_edges : report.nonmanifold_edges);
        for (; edge != end; ++edge) {
          result.neighbours[edge->triangle][edge->edge] = alone ? kBorder : kNonManifold;
        }
      }
      edge = end;
    }
  }
  return result;
}

/// Triangles that hang together over manifold edges.
struct Component {
  std::uint32_t begin = 0;  ///< in `Orienter::order_`
  std::uint32_t end = 0;
  std::uint32_t turned = 0;
  bool closed = true;
  double area = 0.0;
  double volume = 0.0;  ///< about its own centre, where it is open
  Vector3d vector_area = Vector3d::Zero();
  Eigen::AlignedBox3f box;

  [[nodiscard]] bool faces_one_way() const {
    return !closed && vector_area.norm() > kSheetShare * area;
  }
};

class Orienter {
 public:
  Orienter(WeldedMesh& mesh, MeshReport& report)
      : mesh_(mesh),
        report_(report),
        adjacency_(find_neighbours(mesh, report)),
        turned_(mesh.triangles.size(), 0) {}

  MeshTopology run() {
    find_components();
    for (Component& component : components_) {
      if (2 * component.turned > component.end - component.begin) turn(component);
      measure(component);
    }
    const bool sheet = is_sheet();
    if (!sheet) turn_outward();
    apply();
    MeshTopology topology;
    topology.sign = choose_sign(sheet);
    topology.neighbours = std::move(adjacency_.neighbours);
    return topology;
  }

 private:
  void find_components() {
    std::vector<bool> reached(mesh_.triangles.size(), false);
    order_.reserve(mesh_.triangles.size());
    for (std::uint32_t seed = 0; seed < mesh_.triangles.size(); ++seed) {
      if (reached[seed]) continue;
      Component component;
      component.begin = static_cast<std::uint32_t>(order_.size());
      reached[seed] = true;
      order_.push_back(seed);
      for (std::size_t next = component.begin; next < order_.size(); ++next) {
        const std::uint32_t triangle = order_[next];
        component.turned += turned_[triangle];
        for (std::size_t e = 0; e < 3; ++e) {
          const std::uint32_t other = adjacency_.neighbours[triangle][e];
          if (!is_triangle(other)) {
            component.closed = false;
            continue;
          }
          const bool turned = (turned_[triangle] != 0) == adjacency_.alike[triangle][e];
          if (!reached[other]) {
            reached[other] = true;
            turned_[other] = turned ? 1 : 0;
            order_.push_back(other);
          } else if ((turned_[other] != 0) != turned) {
            part(triangle, other);
            component.closed = false;
          }
        }
      }
      component.end = static_cast<std::uint32_t>(order_.size());
      components_.push_back(component);
    }
  }

  /// An edge over which winding cannot be made alike, as on a Moebius strip.
  void part(std::uint32_t a, std::uint32_t b) {
    std::replace(adjacency_.neighbours[a].begin(), adjacency_.neighbours[a].end(), b, kNonManifold);
    std::replace(adjacency_.neighbours[b].begin(), adjacency_.neighbours[b].end(), a, kNonManifold);
    ++report_.nonmanifold_edges;
  }

  void turn(Component& component) {
    for (std::uint32_t i = component.begin; i < component.end; ++i) turned_[order_[i]] ^= 1;
    component.turned = component.end - component.begin - component.turned;
    component.volume = -component.volume;
    component.vector_area = -component.vector_area;
  }

  void measure(Component& component) {
    Vector3d weighted_centre = Vector3d::Zero();
    double volume_at_origin = 0.0;
    const Vector3d origin =
        mesh_.vertices[mesh_.triangles[order_[component.begin]][0]].cast<double>();
    for (std::uint32_t i = component.begin; i < component.end; ++i) {
      const std::uint32_t triangle = order_[i];
      const Corners& corners = mesh_.triangles[triangle];
      for (const std::uint32_t vertex : corners) component.box.extend(mesh_.vertices[vertex]);
      const Vector3d a = mesh_.vertices[corners[0]].cast<double>() - origin;
      const Vector3d b = mesh_.vertices[corners[1]].cast<double>() - origin;
      const Vector3d c = mesh_.vertices[corners[2]].cast<double>() - origin;
      const double side = turned_[triangle] != 0 ? -1.0 : 1.0;
      const Vector3d vector_area = side * 0.5 * (b - a).cross(c - a);
      const double area = vector_area.norm();
      component.area += area;
      component.vector_area += vector_area;
      weighted_centre += area / 3.0 * (a + b + c);
      volume_at_origin += vector_area.dot(a) / 3.0;
    }
    const Vector3d centre = weighted_centre / component.area;
    component.volume = volume_at_origin - component.vector_area.dot(centre) / 3.0;
  }

  [[nodiscard]] bool is_sheet() const {
    if (report_.border_edges == 0) return false;
    Vector3d vector_area = Vector3d::Zero();
    double area = 0.0;
    for (const Component& component : components_) {
      vector_area += component.vector_area;
      area += component.area;
    }
    return vector_area.norm() > kSheetShare * area;
  }

  /// Components whose volume counts negative are turned, but for cavities: clean and closed ones
  /// within another.
  void turn_outward() {
    double volume = 0.0;
    for (const Component& component : components_) {
      if (component.closed) volume += component.volume;
    }
    if (volume < 0.0) {
      for (Component& component : components_) {
        if (component.closed) turn(component);
      }
    }
    const std::vector<Eigen::AlignedBox3f> solids = largest_solids();
    for (Component& component : components_) {
      if (component.volume >= 0.0 || component.faces_one_way()) continue;
      const bool untouched =
          component.turned == 0 || component.turned == component.end - component.begin;
      const bool cavity = component.closed && untouched &&
                          std::any_of(solids.begin(), solids.end(), [&](const auto& solid) {
                            return solid.contains(component.box);
                          });
      if (!cavity) turn(component);
    }
  }

  [[nodiscard]] std::vector<Eigen::AlignedBox3f> largest_solids() const {
    std::vector<Eigen::AlignedBox3f> boxes;
    for (const Component& component : components_) {
      if (component.closed && component.volume > 0.0) boxes.push_back(component.box);
    }
    // What holds cavities is among the largest; with more there would be a tree to search.
    constexpr std::size_t kMost = 64;
    std::stable_sort(boxes.begin(), boxes.end(),
                     [](const auto& a, const auto& b) { return a.volume() > b.volume(); });
    if (boxes.size() > kMost) boxes.resize(kMost);
    return boxes;
  }

  void apply() {
    for (std::size_t i = 0; i < turned_.size(); ++i) {
      if (turned_[i] == 0) continue;
      ++report_.triangles_turned;
      std::swap(mesh_.triangles[i][1], mesh_.triangles[i][2]);
      std::swap(adjacency_.neighbours[i][0], adjacency_.neighbours[i][2]);
    }
  }

  [[nodiscard]] SignRule choose_sign(bool sheet) {
    if (sheet) {
      report_.solid = MeshSolid::sheet;
      return SignRule::sheet;
    }
    if (report_.border_edges > 0 || report_.nonmanifold_edges > 0) {
      report_.solid = MeshSolid::defective;
      return SignRule::winding;
    }
    report_.solid = MeshSolid::closed;
    return boxes_overlap() || has_pinched_vertex() ? SignRule::winding : SignRule::pseudonormal;
  }

  [[nodiscard]] bool boxes_overlap() const {
    std::vector<Eigen::AlignedBox3f> boxes;
    for (const Component& component : components_) boxes.push_back(component.box);
    Eigen::AlignedBox3f all;
    for (const Eigen::AlignedBox3f& box : boxes) all.extend(box);
    Eigen::Index axis = 0;  // along which they lie most apart
    all.sizes().maxCoeff(&axis);
    std::sort(boxes.begin(), boxes.end(),
              [axis](const auto& a, const auto& b) { return a.min()[axis] < b.min()[axis]; });
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t j = i + 1; j < boxes.size() && boxes[j].min()[axis] <= boxes[i].max()[axis];
           ++j) {
        if (boxes[i].intersects(boxes[j])) return true;
      }
    }
    return false;
  }

  /// Whether two cones of triangles meet in nothing but a vertex: there a sum of normals says
  /// nothing. Closed and manifold, a cone is found by going round.
  [[nodiscard]] bool has_pinched_vertex() const {
    std::vector<std::uint32_t> degree(mesh_.vertices.size(), 0);
    for (const Corners& corners : mesh_.triangles) {
      for (const std::uint32_t vertex : corners) ++degree[vertex];
    }
    std::vector<bool> seen(mesh_.vertices.size(), false);
    for (std::uint32_t start = 0; start < mesh_.triangles.size(); ++start) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = mesh_.triangles[start][k];
        if (seen[vertex]) continue;
        seen[vertex] = true;
        std::uint32_t around = 0;
        std::uint32_t triangle = start;
        do {
          const Corners& corners = mesh_.triangles[triangle];
          const auto corner = static_cast<std::size_t>(
              std::find(corners.begin(), corners.end(), vertex) - corners.begin());
          triangle = adjacency_.neighbours[triangle][corner];
          ++around;
        } while (triangle != start && around <= degree[vertex]);
        if (around != degree[vertex]) return true;
      }
    }
    return false;
  }

  WeldedMesh& mesh_;
  MeshReport& report_;
  Adjacency adjacency_;
  std::vector<std::uint8_t> turned_;
  std::vector<std::uint32_t> order_;
  std::vector<Component> components_;
};

}  // namespace

MeshTopology orient(WeldedMesh& mesh, MeshReport& report) { return Orienter(mesh, report).run(); }

}  // namespace nade::detail
