// A mesh file. The first byte says of which kind: o (.obj), s (.stl), p (.ply), f (.off).
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "input_file.h"
#include "nade/io/mesh_file.h"
#include "nade/mesh.h"

namespace {

using namespace nade;

std::string ending_for(std::uint8_t kind) {
  switch (kind) {
    case 'o':
      return ".obj";
    case 's':
      return ".stl";
    case 'p':
      return ".ply";
    default:
      return ".off";
  }
}

/// Whatever a file holds, what is asked of its surface has an answer.
void ask(const MeshSurface& mesh, const Vec3& query) {
  constexpr double kReach_m = 1e9;
  SurfaceHint hint;
  if (const auto nearest = mesh.closest_point(query, kReach_m, hint)) {
    fuzz::demand(nearest->point.allFinite() && nearest->normal.allFinite());
  }
  if (const auto hit = mesh.first_hit({query, -Vec3::UnitY(), kReach_m})) {
    fuzz::demand(hit->point.allFinite() && hit->normal.allFinite());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const fuzz::InputFile file(fuzz::text_of(data + 1, size - 1), ending_for(data[0]));
  const Result<MeshFile> loaded = load_mesh(file.path());
  if (!loaded) return 0;
  const auto mesh = MeshSurface::build(loaded->soup, "input");
  if (!mesh) return 0;
  for (const Vec3& query : {Vec3(0.0, 0.1, 0.0), Vec3(0.01, 0.0, -0.02), Vec3(-3.0, 2.0, 1.0)}) {
    ask(**mesh, query);
  }
  ask(**mesh, loaded->soup.vertices.front().cast<double>());
  return 0;
}
