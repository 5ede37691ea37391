// Makes the dog: a smooth union of rounded shapes, turned into evenly sized triangles.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>

#include "make_dog_body.h"
#include "make_dog_gltf.h"
#include "make_dog_life.h"
#include "make_dog_mesh.h"

namespace {

constexpr double kLatticeSpacing = 0.005;

/// What makes the mesh unfit to be stroked; nothing where it is fit.
std::optional<std::string> find_fault(const dog::Mesh& mesh, const dog::Quality& quality) {
  if (auto defect = dog::topology_defect(mesh)) return defect;
  if (mesh.triangles.size() < 30000 || mesh.triangles.size() > 60000)
    return "expected 30,000 to 60,000 triangles, found " + std::to_string(mesh.triangles.size());
  if (quality.volume <= 0.0) return "its triangles face inward";
  if (quality.largest_miss > 1e-4)
    return "expected every vertex within 0.1 mm of the surface, found " +
           std::to_string(1e3 * quality.largest_miss) + " mm";
  if (quality.smallest_angle_deg < 15.0 || quality.smallest_angle_p01_deg < 32.0)
    return "expected no angle below 15 degrees and 99 of 100 triangles above 32, found " +
           std::to_string(quality.smallest_angle_deg) + " and " +
           std::to_string(quality.smallest_angle_p01_deg);
  if (quality.worst_alignment < 0.5)
    return "a triangle is turned more than 60 degrees off the surface it stands for";
  return dog::life_defect(mesh);
}

int make(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  if (!std::filesystem::is_directory(folder)) {
    std::fprintf(stderr, "%s: expected an existing folder to write into\n",
                 folder.string().c_str());
    return 1;
  }
  const dog::Body body = dog::make_body();
  const dog::Mesh mesh = dog::remesh(body, dog::extract_surface(body, kLatticeSpacing));
  const dog::Quality quality = dog::measure_quality(body, mesh);
  std::printf(
      "%s: %zu vertices, %zu triangles, smallest angle %.1f deg (1st percentile %.1f, median "
      "%.1f), vertices within %.4f mm of the surface, triangles within cosine %.2f of it\n",
      path.c_str(), mesh.points.size(), mesh.triangles.size(), quality.smallest_angle_deg,
      quality.smallest_angle_p01_deg, quality.smallest_angle_p50_deg, 1e3 * quality.largest_miss,
      quality.worst_alignment);
  std::optional<std::string> fault = find_fault(mesh, quality);
  if (fault) fault = "make_dog: the dog's mesh is unfit: " + *fault;
  if (!fault) fault = dog::write_glb(body, mesh, dog::find_places(body), path);
  if (fault) std::fprintf(stderr, "%s\n", fault->c_str());
  return fault ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_dog OUT.glb\n");
    return 2;
  }
  try {
    return make(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_dog: %s\n", error.what());
    return 1;
  }
}
