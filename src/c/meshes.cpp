#include <limits>

#include "arguments.h"
#include "convert.h"
#include "nade/mesh.h"
#include "nade/solids.h"

namespace nade::c_abi {
namespace {

std::vector<Eigen::Vector3f> points_from(const float* values, std::size_t count) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  }
  return points;
}

nade_status refuse_data(const Error& error) {
  return fail(NADE_ERROR_DATA, "%s", error.message.c_str());
}

/// A mesh of what was given, not to be refitted.
nade_status make_solid_of(const Result<TriangleSoup>& soup, const char* name,
                          nade_surface** handle) {
  if (!soup) return refuse_data(soup.error());
  Result<std::unique_ptr<MeshSurface>> built = MeshSurface::build(soup.value(), name);
  if (!built) return refuse_data(built.error());
  auto held = std::make_shared<HeldSurface>();
  held->surface = std::move(built).value();
  *handle = HandlePool<nade_surface>::take(std::move(held));
  return NADE_OK;
}

TriangleSoup soup_from(const nade_mesh& mesh, const Eigen::Vector3f& scale) {
  TriangleSoup soup;
  soup.vertices = points_from(mesh.vertices, mesh.vertex_count);
  soup.triangles.resize(mesh.triangle_count);
  std::memcpy(soup.triangles.data(), mesh.triangles,
              soup.triangles.size() * sizeof soup.triangles[0]);
  return scaled(std::move(soup), scale.cast<double>());
}

nade_mesh_report report_from(const MeshReport& found) {
  nade_mesh_report report{};
  report.solid = static_cast<nade_solid>(found.solid);
  report.triangles_used = static_cast<std::uint32_t>(found.triangles_used);
  report.triangles_degenerate = static_cast<std::uint32_t>(found.triangles_degenerate);
  report.triangles_duplicate = static_cast<std::uint32_t>(found.triangles_duplicate);
  report.triangles_turned = static_cast<std::uint32_t>(found.triangles_turned);
  report.border_edges = static_cast<std::uint32_t>(found.border_edges);
  report.nonmanifold_edges = static_cast<std::uint32_t>(found.nonmanifold_edges);
  return report;
}

nade_status make_mesh(const nade_mesh& mesh, nade_mesh_report* report, nade_surface** handle) {
  auto held = std::make_shared<HeldSurface>();
  const Eigen::Vector3f scale = vector_from(mesh.scale).cast<float>();
  if (!scale.isZero(0.0F)) held->scale = scale;
  Result<std::unique_ptr<MeshSurface>> built =
      MeshSurface::build(soup_from(mesh, held->scale), "mesh");
  if (!built) return refuse_data(built.error());
  held->mesh = built.value().get();
  held->surface = std::move(built).value();
  held->vertices.resize(mesh.vertex_count);
  const nade_mesh_report found = report_from(held->mesh->report());
  *handle = HandlePool<nade_surface>::take(std::move(held));
  if (report != nullptr) write(found, *report);
  return NADE_OK;
}

}  // namespace
}  // namespace nade::c_abi

using nade::c_abi::Arguments;
using nade::c_abi::guarded;

extern "C" {

nade_status nade_surface_create_hull(const float* points, size_t count,
                                     nade_surface** surface) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments =
        Arguments().given(surface, "surface").given(points, "points").at_least(count, 4, "count");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_solid_of(nade::convex_hull(nade::c_abi::points_from(points, count)),
                                      "convex hull", surface);
  });
}

nade_status nade_surface_create_height_field(const float* heights, size_t columns, size_t rows,
                                             double step_m, nade_surface** surface) noexcept {
  return guarded(__func__, [&] {
    Arguments arguments;
    arguments.given(surface, "surface")
        .given(heights, "heights")
        .at_least(columns, 2, "columns")
        .at_least(rows, 2, "rows")
        .above_zero(step_m, "step_m")
        .expects(rows <= std::numeric_limits<std::uint32_t>::max() / columns, NADE_ERROR_ARGUMENT,
                 "rows: too many heights");
    if (arguments.ok()) arguments.finite(heights, columns * rows, "heights");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_solid_of(
        nade::height_field({heights, columns * rows}, columns, step_m), "height field", surface);
  });
}

nade_status nade_surface_create_mesh(const nade_mesh* mesh, nade_mesh_report* report,
                                     nade_surface** surface) noexcept {
  return guarded(__func__, [&] {
    Arguments arguments;
    arguments.given(surface, "surface").read(mesh, "mesh");
    if (report != nullptr) arguments.sized(report, "report");
    if (!arguments.ok()) return arguments.status();
    arguments.given(mesh->vertices, "mesh: vertices")
        .given(mesh->triangles, "mesh: triangles")
        .finite(mesh->scale, 3, "mesh: scale");
    const int zeros =
        (mesh->scale[0] == 0.0F) + (mesh->scale[1] == 0.0F) + (mesh->scale[2] == 0.0F);
    arguments.expects(zeros == 0 || zeros == 3, NADE_ERROR_ARGUMENT,
                      "mesh: scale: expected no 0, or all 0 for none");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_mesh(*mesh, report, surface);
  });
}

nade_status nade_surface_refit(nade_surface* mesh, const float* vertices,
                               size_t vertex_count) noexcept {
  return guarded(__func__, [&] {
    Arguments arguments;
    arguments.handle(mesh, "mesh").given(vertices, "vertices");
    if (!arguments.ok()) return arguments.status();
    nade::c_abi::HeldSurface& held = **mesh->contents;
    arguments
        .expects(held.mesh != nullptr, NADE_ERROR_HANDLE,
                 "mesh: expected one by nade_surface_create_mesh")
        .expects(vertex_count == held.vertices.size(), NADE_ERROR_ARGUMENT,
                 "vertex_count: expected as many as the mesh was created from");
    if (arguments.ok()) arguments.finite(vertices, 3 * vertex_count, "vertices");
    if (!arguments.ok()) return arguments.status();
    for (std::size_t i = 0; i < vertex_count; ++i) {
      held.vertices[i] = Eigen::Vector3f(vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2])
                             .cwiseProduct(held.scale);
    }
    held.mesh->refit(held.vertices);
    return arguments.status();
  });
}

}  // extern "C"
