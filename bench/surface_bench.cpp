// Rays and closest points of MeshSurface beside Embree's on the same mesh, in one run; their
// growth with the number of triangles; and the time to build.
//     surface_bench [BUNNY_INDEX_JS]
// Answers are checked against Embree's; the exit status is 1 where they differ.

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

#include "nade/mesh.h"
#include "stopwatch.h"
#include "support/meshes.h"
#include "support/random.h"

namespace {

using namespace nade;
using bench::Clock;
using bench::Stopwatch;
using bench::Summary;
using test::Random;

constexpr int kQueries = 200000;
constexpr int kPaths = 64;         ///< as many points as a drawn hand's patches have
constexpr double kNear_m = 0.01;   ///< closest points are asked for this near the surface
constexpr double kStep_m = 0.004;  ///< 0.36 m/s at 90 frames a second

/// Embree's scene of one mesh, and the two queries made on it.
class EmbreeMesh {
 public:
  explicit EmbreeMesh(const TriangleSoup& soup)
      : soup_(soup), device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), soup.vertices.size()));
    for (const Eigen::Vector3f& v : soup.vertices) vertices = std::copy_n(v.data(), 3, vertices);
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), soup.triangles.size()));
    for (const auto& t : soup.triangles) indices = std::copy_n(t.data(), 3, indices);
    rtcSetGeometryPointQueryFunction(geometry, visit);
    rtcSetGeometryUserData(geometry, this);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(scene_);
  }
  ~EmbreeMesh() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeMesh(const EmbreeMesh&) = delete;
  EmbreeMesh& operator=(const EmbreeMesh&) = delete;

  /// Infinity where nothing is hit.
  [[nodiscard]] float first_hit(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray.org_x = static_cast<float>(ray.origin.x());
    query.ray.org_y = static_cast<float>(ray.origin.y());
    query.ray.org_z = static_cast<float>(ray.origin.z());
    query.ray.dir_x = static_cast<float>(ray.direction.x());
    query.ray.dir_y = static_cast<float>(ray.direction.y());
    query.ray.dir_z = static_cast<float>(ray.direction.z());
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = 0xffffffff;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &query);
    return query.ray.tfar;
  }

  /// Infinity where nothing is within `reach`.
  [[nodiscard]] float distance(const Vec3& point, double reach) const {
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    RTCPointQuery query{};
    query.x = static_cast<float>(point.x());
    query.y = static_cast<float>(point.y());
    query.z = static_cast<float>(point.z());
    query.radius = static_cast<float>(reach);
    Search search{this, std::numeric_limits<float>::infinity()};
    rtcPointQuery(scene_, &query, &context, nullptr, &search);
    return search.distance;
  }

 private:
  struct Search {
    const EmbreeMesh* mesh;
    float distance;
  };

  static bool visit(RTCPointQueryFunctionArguments* arguments) {
    auto& search = *static_cast<Search*>(arguments->userPtr);
    const auto& triangle = search.mesh->soup_.triangles[arguments->primID];
    const auto& vertices = search.mesh->soup_.vertices;
    const Eigen::Vector3f point(arguments->query->x, arguments->query->y, arguments->query->z);
    const float distance =
        to_triangle(point, vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]);
    if (distance >= arguments->query->radius) return false;
    search.distance = arguments->query->radius = distance;
    return true;
  }

  /// Ericson, Real-Time Collision Detection, 2005, 5.1.5: as in Embree's own tutorial.
  static float to_triangle(const Eigen::Vector3f& p, const Eigen::Vector3f& a,
                           const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
    const Eigen::Vector3f ab = b - a;
    const Eigen::Vector3f ac = c - a;
    const float d1 = ab.dot(p - a);
    const float d2 = ac.dot(p - a);
    if (d1 <= 0.0F && d2 <= 0.0F) return (p - a).norm();
    const float d3 = ab.dot(p - b);
    const float d4 = ac.dot(p - b);
    if (d3 >= 0.0F && d4 <= d3) return (p - b).norm();
    const float d5 = ab.dot(p - c);
    const float d6 = ac.dot(p - c);
    if (d6 >= 0.0F && d5 <= d6) return (p - c).norm();
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0F && d1 >= 0.0F && d3 <= 0.0F) return (p - (a + d1 / (d1 - d3) * ab)).norm();
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0F && d2 >= 0.0F && d6 <= 0.0F) return (p - (a + d2 / (d2 - d6) * ac)).norm();
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0.0F && d4 >= d3 && d5 >= d6) {
      return (p - (b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b))).norm();
    }
    const float scale = 1.0F / (va + vb + vc);
    return (p - (a + vb * scale * ab + vc * scale * ac)).norm();
  }

  const TriangleSoup& soup_;
  RTCDevice device_;
  RTCScene scene_;
};

Eigen::AlignedBox3f box_of(const TriangleSoup& soup) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : soup.vertices) box.extend(vertex);
  return box;
}

/// From around and inside the mesh, any way, at what is in its box.
std::vector<Ray> make_rays(const TriangleSoup& soup) {
  const Eigen::AlignedBox3f box = box_of(soup);
  const Vec3 low = box.min().cast<double>();
  const Vec3 high = box.max().cast<double>();
  const Vec3 margin = 0.25 * (high - low);
  Random random;
  std::vector<Ray> rays(kQueries);
  for (Ray& ray : rays) {
    ray.origin = random.point(low - margin, high + margin);
    ray.direction = (random.point(low, high) - ray.origin).normalized();
  }
  return rays;
}

/// Frame by frame, `kPaths` points that stroke along the surface within `kNear_m` of it.
std::vector<Vec3> make_strokes(const MeshSurface& mesh, const TriangleSoup& soup) {
  struct Path {
    Vec3 on_surface;
    Vec3 heading;
    double height;
    SurfaceHint hint;
  };
  Random random;
  std::vector<Path> paths(kPaths);
  for (Path& path : paths) {
    path.on_surface = soup.vertices[random.below(static_cast<std::uint32_t>(soup.vertices.size()))]
                          .cast<double>();
    path.heading = random.direction();
  }
  std::vector<Vec3> points;
  points.reserve(kQueries);
  while (points.size() < kQueries) {
    for (Path& path : paths) {
      path.heading = (path.heading + 0.2 * random.direction()).normalized();
      path.height = std::clamp(path.height + random.uniform(-0.001, 0.001), -kNear_m, kNear_m);
      const auto on = mesh.closest_point(path.on_surface + kStep_m * path.heading, 1e9, path.hint);
      path.on_surface = on->point;
      path.heading = along_surface(path.heading, on->normal).normalized();
      points.push_back(path.on_surface + path.height * on->normal);
    }
  }
  return points;
}

struct Comparison {
  Summary ours;
  Summary embree;
  int different = 0;
};

/// Runs both by turns, a few thousand queries each, so that whatever else the machine does falls
/// on both.
template <class Ours, class Theirs>
Comparison time_by_turns(std::size_t count, Ours&& ours, Theirs&& theirs) {
  constexpr std::size_t kTurn = 5000;
  Stopwatch our_watch(count);
  Stopwatch their_watch(count);
  for (std::size_t begin = 0; begin < count; begin += kTurn) {
    const std::size_t end = std::min(begin + kTurn, count);
    for (std::size_t i = begin; i < end; ++i) our_watch.measure([&] { ours(i); });
    for (std::size_t i = begin; i < end; ++i) their_watch.measure([&] { theirs(i); });
  }
  return {our_watch.summary(), their_watch.summary()};
}

Comparison time_rays(const MeshSurface& mesh, const EmbreeMesh& embree,
                     const std::vector<Ray>& rays) {
  std::vector<double> ours(rays.size());
  std::vector<double> theirs(rays.size());
  Comparison times = time_by_turns(
      rays.size(),
      [&](std::size_t i) {
        const auto hit = mesh.first_hit(rays[i]);
        ours[i] = hit ? hit->distance : std::numeric_limits<double>::infinity();
      },
      [&](std::size_t i) { theirs[i] = static_cast<double>(embree.first_hit(rays[i])); });
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!(ours[i] == theirs[i] || std::abs(ours[i] - theirs[i]) < 1e-5)) ++times.different;
  }
  return times;
}

Comparison time_points(const MeshSurface& mesh, const EmbreeMesh& embree,
                       const std::vector<Vec3>& points) {
  std::vector<double> ours(points.size());
  std::vector<double> theirs(points.size());
  std::vector<SurfaceHint> hints(kPaths);
  constexpr double kReach = 2.0 * kNear_m;
  Comparison times = time_by_turns(
      points.size(),
      [&](std::size_t i) {
        const auto found = mesh.closest_point(points[i], kReach, hints[i % kPaths]);
        ours[i] =
            found ? std::abs(found->signed_distance) : std::numeric_limits<double>::infinity();
      },
      [&](std::size_t i) { theirs[i] = static_cast<double>(embree.distance(points[i], kReach)); });
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(std::abs(ours[i] - theirs[i]) < 1e-6)) ++times.different;
  }
  return times;
}

std::unique_ptr<MeshSurface> build(const TriangleSoup& soup) {
  return std::move(MeshSurface::build(soup, "bench").value());
}

double build_ms(const TriangleSoup& soup) {
  std::vector<double> times;
  for (int i = 0; i < 5; ++i) {
    const auto start = Clock::now();
    const auto mesh = build(soup);
    times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

void print(const char* what, const Comparison& times) {
  fmt::print("{:<34}{:>9.0f}{:>9.0f}{:>11.0f}{:>9.0f}{:>9.2f}{:>9.2f}{:>8}\n", what,
             times.ours.median_ns, times.ours.p99_ns, times.embree.median_ns, times.embree.p99_ns,
             times.ours.median_ns / times.embree.median_ns, times.ours.p99_ns / times.embree.p99_ns,
             times.different);
}

}  // namespace

int main(int argc, char** argv) {
  const auto bunny = argc > 1 ? test::load_bunny(argv[1]) : test::find_bunny();
  const TriangleSoup soup =
      bunny ? test::subdivided(*bunny, 2) : test::bumpy_sphere(0.12F, 170, 174);
  fmt::print("{}, {} triangles; times in ns\n", bunny ? "bunny" : "bumpy sphere",
             soup.triangles.size());
  fmt::print("{:<34}{:>9}{:>9}{:>11}{:>9}{:>9}{:>9}{:>8}\n", "", "median", "p99", "Embree", "p99",
             "ratio", "p99", "differ");
  int different = 0;
  {
    const auto mesh = build(soup);
    const EmbreeMesh embree(soup);
    const Comparison rays = time_rays(*mesh, embree, make_rays(soup));
    print("ray", rays);
    const Comparison points = time_points(*mesh, embree, make_strokes(*mesh, soup));
    print("closest point, stroking", points);
    different = rays.different + points.different;
  }
  for (const std::uint32_t sectors : {22U, 71U, 224U, 708U}) {
    const TriangleSoup sphere = test::bumpy_sphere(0.12F, sectors, sectors + 2);
    const auto mesh = build(sphere);
    const EmbreeMesh embree(sphere);
    const std::string size = fmt::format(", {} triangles", sphere.triangles.size());
    const Comparison rays = time_rays(*mesh, embree, make_rays(sphere));
    print(("ray" + size).c_str(), rays);
    const Comparison points = time_points(*mesh, embree, make_strokes(*mesh, sphere));
    print(("closest point" + size).c_str(), points);
    different += points.different;
  }
  const TriangleSoup hundred = test::bumpy_sphere(0.12F, 224, 224);
  fmt::print("build, {} triangles: {:.1f} ms\n", hundred.triangles.size(), build_ms(hundred));
  // A ray along an edge may miss with one and hit with the other.
  constexpr int kForgiven = 5;
  return different > kForgiven ? 1 : 0;
}
