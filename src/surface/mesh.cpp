#include "nade/mesh.h"

#include <algorithm>
#include <cmath>

#include "mesh_normals.h"
#include "mesh_topology.h"
#include "nade/assert.h"
#include "query_steps.h"
#include "surface_query.h"
#include "triangle_tree.h"

// Based on: Baerentzen, Aanaes. Signed Distance Computation Using the Angle Weighted
// Pseudonormal. 2005.
// Based on: Jacobson, Kavan, Sorkine-Hornung. Robust Inside-Outside Segmentation using
// Generalized Winding Numbers. 2013.
// Based on: Ericson. Real-Time Collision Detection. 2005 (the regions of a triangle).

namespace nade {
namespace {

using detail::Corners;
using detail::kNoSlot;
using detail::SlotTriangle;

/// Which part of a triangle a point is nearest to.
enum class Feature : std::uint8_t { vertex_0, vertex_1, vertex_2, edge_01, edge_12, edge_20, face };

struct TrianglePoint {
  Vec3 point;
  Vec3 weights;  ///< of the corners
  Feature feature;
};

TrianglePoint nearest_on(const std::array<Vec3, 3>& corners, const Vec3& query) {
  const auto& [a, b, c] = corners;
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 aq = query - a;
  const double ab_a = ab.dot(aq);
  const double ac_a = ac.dot(aq);
  if (ab_a <= 0.0 && ac_a <= 0.0) return {a, Vec3::UnitX(), Feature::vertex_0};
  const Vec3 bq = query - b;
  const double ab_b = ab.dot(bq);
  const double ac_b = ac.dot(bq);
  if (ab_b >= 0.0 && ac_b <= ab_b) return {b, Vec3::UnitY(), Feature::vertex_1};
  const Vec3 cq = query - c;
  const double ab_c = ab.dot(cq);
  const double ac_c = ac.dot(cq);
  if (ac_c >= 0.0 && ab_c <= ac_c) return {c, Vec3::UnitZ(), Feature::vertex_2};
  const double at_c = ab_a * ac_b - ab_b * ac_a;
  if (at_c <= 0.0 && ab_a >= 0.0 && ab_b <= 0.0) {
    const double share = ab_a / (ab_a - ab_b);
    return {a + share * ab, {1.0 - share, share, 0.0}, Feature::edge_01};
  }
  const double at_b = ab_c * ac_a - ab_a * ac_c;
  if (at_b <= 0.0 && ac_a >= 0.0 && ac_c <= 0.0) {
    const double share = ac_a / (ac_a - ac_c);
    return {a + share * ac, {1.0 - share, 0.0, share}, Feature::edge_20};
  }
  const double at_a = ab_b * ac_c - ab_c * ac_b;
  if (at_a <= 0.0 && ac_b >= ab_b && ab_c >= ac_c) {
    const double share = (ac_b - ab_b) / ((ac_b - ab_b) + (ab_c - ac_c));
    return {b + share * (c - b), {0.0, 1.0 - share, share}, Feature::edge_12};
  }
  const double sum = at_a + at_b + at_c;
  // Only a triangle without area, which a refit may bring about, gets here with nothing.
  if (!(sum > 0.0)) return {a, Vec3::UnitX(), Feature::vertex_0};
  const double v = at_b / sum;
  const double w = at_c / sum;
  return {a + v * ab + w * ac, {1.0 - v - w, v, w}, Feature::face};
}

/// Not normalised.
Vec3 face_normal(const std::array<Vec3, 3>& corners) {
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]);
}

/// `norm`, also where its square would be too large for a double.
double length(const Vec3& vector) {
  const double norm = vector.norm();
  return std::isfinite(norm) ? norm : vector.stableNorm();
}

struct Crossing {
  TrianglePoint at;
  double distance;
  bool from_behind;
};

/// Where the ray's line meets the triangle's plane, moved onto the triangle where rounding puts
/// it beside.
Crossing cross(const std::array<Vec3, 3>& corners, const Ray& ray) {
  const auto& [a, b, c] = corners;
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 from_a = ray.origin - a;
  const Vec3 across = ray.direction.cross(ac);
  const Vec3 along = from_a.cross(ab);
  const double facing = ab.dot(across);
  const double inverse = 1.0 / facing;
  const double v = from_a.dot(across) * inverse;
  const double w = ray.direction.dot(along) * inverse;
  const double distance = ac.dot(along) * inverse;
  const bool from_behind = facing < 0.0;
  const Vec3 point = ray.origin + distance * ray.direction;
  if (v >= 0.0 && w >= 0.0 && v + w <= 1.0) {
    return {{point, {1.0 - v - w, v, w}, Feature::face}, distance, from_behind};
  }
  const TrianglePoint nearest = nearest_on(corners, std::isfinite(inverse) ? point : a);
  return {nearest, (nearest.point - ray.origin).dot(ray.direction), from_behind};
}

/// Unit; the face's where interpolation cancels out.
Vec3 shading_normal(const SlotTriangle& triangle, const Vec3& weights) {
  const Vec3 normal = weights[0] * triangle.normals[0] + weights[1] * triangle.normals[1] +
                      weights[2] * triangle.normals[2];
  const double norm = normal.norm();
  constexpr double kShortest = 1e-3;
  if (norm > kShortest) return normal / norm;
  const Vec3 face = face_normal(triangle.corners);
  return face.squaredNorm() > 0.0 ? face.stableNormalized() : Vec3::UnitY();
}

/// What float arithmetic on squares of squares still holds, metres.
constexpr float kLargest = 1e6F;
/// So many diagonals of the built mesh may a vertex go: far ones make boxes wide, and queries slow.
constexpr float kRoom = 100.0F;

/// A little more, so that a bound includes what lies on it.
float round_up(double value) { return static_cast<float>(value * (1.0 + 1e-6)) + 1e-18F; }

}  // namespace

struct MeshSurface::Impl {
  MeshReport report;
  detail::WeldedMesh mesh;
  detail::MeshTopology topology;
  detail::MeshNormals normals;
  detail::TriangleTree tree;
  std::size_t soup_vertices = 0;
  Eigen::AlignedBox3f room;  ///< where vertices may go
  std::uint64_t shape = new_shape();
  Vec3 centre = Vec3::Zero();
  double radius = 0.0;

  void follow_vertices() {
    tree.set_triangles(mesh.vertices, mesh.triangles);
    normals.update(mesh, tree);
    tree.set_shading(normals.shading(), normals.shading_of());
    if (topology.sign == detail::SignRule::winding) tree.set_dipoles();
    const Eigen::AlignedBox3f& bounds = tree.bounds();
    centre = bounds.center().cast<double>();
    radius = 0.5 * bounds.diagonal().cast<double>().norm();
  }

  /// Of the feature that is nearest, not normalised: the face, or those that meet in an edge or a
  /// vertex. No value at a border, where inside and outside meet.
  [[nodiscard]] std::optional<Vec3> pseudonormal(std::uint32_t slot, const TrianglePoint& nearest,
                                                 const Vec3& face) const {
    if (nearest.feature == Feature::face) return face;
    const std::uint32_t triangle = tree.triangle_at(slot);
    if (nearest.feature < Feature::edge_01) {
      const auto corner = static_cast<std::size_t>(nearest.feature);
      const std::uint32_t vertex = mesh.triangles[triangle][corner];
      if (topology.sign == detail::SignRule::sheet && normals.on_border(vertex)) return {};
      return normals.vertex_pseudonormal(vertex);
    }
    const auto edge =
        static_cast<std::size_t>(nearest.feature) - static_cast<std::size_t>(Feature::edge_01);
    const std::uint32_t other = topology.neighbours[triangle][edge];
    if (other == detail::kBorder) return {};
    Vec3 sum = face.stableNormalized();
    if (detail::is_triangle(other)) sum += detail::face_normal(mesh, other).stableNormalized();
    return sum;
  }

  /// `around` is the pseudonormal at `nearest`.
  [[nodiscard]] bool is_inside(const Vec3& from, const Vec3& nearest,
                               const std::optional<Vec3>& around) const {
    if (topology.sign != detail::SignRule::winding) {
      return around && around->dot(from - nearest) < 0.0;
    }
    const Eigen::Vector3f at = from.cast<float>();
    const detail::TreeWinding winding = tree.winding({at.x(), at.y(), at.z()});
    detail::steps_left -= winding.steps;
    return winding.number > 0.5F;
  }

  [[nodiscard]] SurfacePoint point_at(const Vec3& query, const Vec3& seen_from, std::uint32_t slot,
                                      const SlotTriangle& triangle,
                                      const TrianglePoint& nearest) const {
    const Vec3 face = face_normal(triangle.corners);
    const double distance = length(query - nearest.point);
    SurfacePoint result{nearest.point, shading_normal(triangle, nearest.weights), distance};
    const std::optional<Vec3> around = pseudonormal(slot, nearest, face);
    if (around && nearest.feature != Feature::face) {
      // On a crease the normal is nobody's own: which of its faces was found is an accident. Faces
      // that cancel out say nothing.
      constexpr double kOffCosine = 0.966;
      constexpr double kCancelled = 0.01;
      const double norm = around->norm();
      if (norm > kCancelled && around->dot(result.normal) < kOffCosine * norm) {
        result.normal = *around / norm;
      }
    }
    if (is_inside(seen_from, nearest.point, around)) result.signed_distance = -distance;
    return result;
  }
};

MeshSurface::MeshSurface(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
MeshSurface::~MeshSurface() = default;

Result<std::unique_ptr<MeshSurface>> MeshSurface::build(const TriangleSoup& soup,
                                                        const std::string& name) {
  const auto refuse = [&](const std::string& what) {
    return Error{ErrorCode::bad_value, name + ": " + what};
  };
  for (std::size_t i = 0; i < soup.vertices.size(); ++i) {
    if (!soup.vertices[i].allFinite()) {
      return refuse("vertex " + std::to_string(i) + ": expected finite coordinates");
    }
    if (soup.vertices[i].cwiseAbs().maxCoeff() > kLargest) {
      return refuse("vertex " + std::to_string(i) +
                    ": expected coordinates within 1000 km of the origin");
    }
  }
  for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
    for (const std::uint32_t vertex : soup.triangles[i]) {
      if (vertex >= soup.vertices.size()) {
        return refuse("triangle " + std::to_string(i) + ": expected vertices below " +
                      std::to_string(soup.vertices.size()) + ", found " + std::to_string(vertex));
      }
    }
  }
  auto impl = std::make_unique<Impl>();
  impl->soup_vertices = soup.vertices.size();
  impl->mesh = detail::weld(soup, impl->report);
  if (impl->mesh.triangles.empty()) {
    const std::string found =
        soup.triangles.empty() ? "none" : std::to_string(soup.triangles.size()) + " without";
    return refuse("expected at least one triangle with an area, found " + found);
  }
  detail::reorder(impl->mesh, impl->tree.build(impl->mesh.vertices, impl->mesh.triangles));
  impl->topology = detail::orient(impl->mesh, impl->report);
  impl->normals.build(impl->mesh, impl->topology);
  impl->follow_vertices();
  const Eigen::AlignedBox3f& bounds = impl->tree.bounds();
  const Eigen::Vector3f reach = Eigen::Vector3f::Constant(kRoom * bounds.diagonal().norm());
  impl->room = {(bounds.min() - reach).cwiseMax(-kLargest),
                (bounds.max() + reach).cwiseMin(kLargest)};
  return std::unique_ptr<MeshSurface>(new MeshSurface(std::move(impl)));
}

std::optional<RayHit> MeshSurface::first_hit(const Ray& ray) const noexcept {
  if (!is_query(ray) || detail::steps_left <= 0) return std::nullopt;
  // A far origin is brought near along the ray, where floats are fine enough.
  double skipped = 0.0;
  const double to_centre = (impl_->centre - ray.origin).dot(ray.direction);
  constexpr double kFar = 4.0;
  if (!(std::abs(to_centre) <= kFar * impl_->radius)) {
    skipped = to_centre - 2.0 * impl_->radius;
    if (!(skipped > 0.0 && skipped <= ray.max_distance)) return std::nullopt;
  }
  const Vec3 origin = ray.origin + skipped * ray.direction;
  const double miss_squared =
      (impl_->centre - origin - (to_centre - skipped) * ray.direction).squaredNorm();
  constexpr double kRounding = 1.0 + 1e-6;
  if (!(miss_squared <= kRounding * impl_->radius * impl_->radius)) return std::nullopt;
  detail::TreeRay query{};
  for (int axis = 0; axis < 3; ++axis) {
    query.origin[axis] = static_cast<float>(origin[axis]);
    query.direction[axis] = static_cast<float>(ray.direction[axis]);
  }
  query.max_distance = round_up(std::min(ray.max_distance - skipped, 2.0 * kFar * impl_->radius));
  const detail::TreeHit hit = impl_->tree.first_hit(query);
  detail::steps_left -= hit.steps;
  if (hit.slot == kNoSlot) return std::nullopt;

  const SlotTriangle triangle = impl_->tree.at(hit.slot);
  const Crossing met = cross(triangle.corners, ray);
  const double distance = std::max(0.0, met.distance);
  if (distance > ray.max_distance) return std::nullopt;
  Vec3 normal = shading_normal(triangle, met.at.weights);
  // Interpolation may tip a normal over to the other side of a grazing ray: lay it across.
  const double along = normal.dot(ray.direction);
  if ((along > 0.0) != met.from_behind) {
    constexpr double kOver = 1.0 + 1e-9;
    const Vec3 across = normal - kOver * along * ray.direction;
    normal = across.squaredNorm() > 0.0 ? across.normalized()
                                        : face_normal(triangle.corners).stableNormalized();
  }
  return RayHit{distance, met.at.point, normal, met.from_behind};
}

std::optional<SurfacePoint> MeshSurface::closest_point(const Vec3& query, double max_distance,
                                                       SurfaceHint& hint) const noexcept {
  if (!is_query(query, max_distance) || detail::steps_left <= 0) return std::nullopt;
  // From very far, look from a nearer point in the same direction.
  Vec3 seen_from = query;
  constexpr double kFar = 1e4;
  const double from_centre = length(query - impl_->centre);
  if (!(from_centre <= kFar * impl_->radius)) {
    if (from_centre - impl_->radius > max_distance) return std::nullopt;
    seen_from = impl_->centre + kFar * impl_->radius * (query - impl_->centre).stableNormalized();
  }
  detail::TreePoint tree_query{};
  for (int axis = 0; axis < 3; ++axis) {
    tree_query.point[axis] = static_cast<float>(seen_from[axis]);
  }
  tree_query.hint_block =
      impl_->tree.has(hint.element) ? hint.element / detail::kTreeWidth : kNoSlot;
  const double bound =
      std::min(max_distance + (query - seen_from).norm(), 4.0 * kFar * impl_->radius);
  const float rounded = round_up(bound);
  tree_query.bound_squared = rounded * rounded;
  const detail::TreeNearest found = impl_->tree.closest(tree_query);
  detail::steps_left -= found.steps;
  if (found.slot == kNoSlot) return std::nullopt;

  const SlotTriangle triangle = impl_->tree.at(found.slot);
  const TrianglePoint nearest = nearest_on(triangle.corners, query);
  if (!(length(query - nearest.point) <= max_distance)) return std::nullopt;
  hint.element = found.slot;
  if (found.steps == detail::kMostSteps && impl_->topology.sign != detail::SignRule::winding) {
    // It may not be the nearest, whose pseudonormal alone says on which side the query is: what
    // is first on the way to it says so too.
    constexpr double kBeyond = 1.0 + 1e-6;
    const Vec3 way = nearest.point - query;
    const auto hit = first_hit({query, way.stableNormalized(), kBeyond * length(way)});
    if (hit)
      return SurfacePoint{hit->point, hit->normal, (hit->from_inside ? -1 : 1) * hit->distance};
  }
  return impl_->point_at(query, seen_from, found.slot, triangle, nearest);
}

void MeshSurface::refit(std::span<const Eigen::Vector3f> vertices) noexcept {
  NADE_ASSERT(vertices.size() == impl_->soup_vertices);
  for (std::size_t i = 0; i < impl_->mesh.vertices.size(); ++i) {
    const Eigen::Vector3f& moved = vertices[impl_->mesh.source[i]];
    if (impl_->room.contains(moved)) impl_->mesh.vertices[i] = moved;
  }
  impl_->follow_vertices();
  impl_->shape = new_shape();
}

std::uint64_t MeshSurface::shape() const noexcept { return impl_->shape; }

std::optional<SurfaceBounds> MeshSurface::bounds() const noexcept {
  const Eigen::AlignedBox3f& box = impl_->tree.bounds();
  return SurfaceBounds{box.min().cast<double>(), box.max().cast<double>()};
}

const MeshReport& MeshSurface::report() const { return impl_->report; }

}  // namespace nade
