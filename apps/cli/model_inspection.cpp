#include "model_inspection.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "inspection.h"
#include "nade/io/mesh_file.h"
#include "nade/io/object_file.h"
#include "nade/io/plain_text.h"

namespace nade::cli {
namespace {

using Json = nlohmann::ordered_json;

double to_micrometre(float metres) { return std::round(double{metres} * 1e6) / 1e6; }

std::string shown_name(const Json& named) {
  const auto& name = named["name"].get_ref<const std::string&>();
  return name.empty() ? "(no name)" : name;
}

}  // namespace

Result<Json> inspect_model(const std::string& path) {
  const Result<MeshFile> file = load_mesh(path);
  if (!file) return file.error();
  const Result<LoadedObject> object = load_object(path);
  if (!object) return object.error();
  Eigen::Vector3f least = file->soup.vertices.front();
  Eigen::Vector3f greatest = least;
  for (const Eigen::Vector3f& vertex : file->soup.vertices) {
    least = least.cwiseMin(vertex);
    greatest = greatest.cwiseMax(vertex);
  }
  Json json;
  json["format"] = ending_of(path).substr(1);
  json["vertices"] = file->soup.vertices.size();
  json["triangles"] = file->soup.triangles.size();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    json["size_m"].push_back(to_micrometre(greatest[axis] - least[axis]));
    json["range_m"].push_back({to_micrometre(least[axis]), to_micrometre(greatest[axis])});
  }
  json["meshes"] = Json::array();
  for (const MeshPart& part : file->parts) {
    json["meshes"].push_back(
        {{"name", part.name}, {"vertices", part.vertices}, {"triangles", part.triangles}});
  }
  json["animations"] = Json::array();
  for (const MeshAnimation& animation : file->animations) {
    json["animations"].push_back({{"name", animation.name}, {"duration_s", animation.duration_s}});
  }
  json["places"] = Json::array();
  for (const MeshPlace& place : file->places) json["places"].push_back(place.name);
  json["warnings"] = object->warnings;
  return json;
}

std::string model_as_text(const Json& report) {
  std::string text;
  append_row(text, "format", report["format"].get<std::string>());
  append_row(text, "triangles",
             fmt::format("{} with {} vertices", report["triangles"].get<std::size_t>(),
                         report["vertices"].get<std::size_t>()));
  const Json& size = report["size_m"];
  append_row(text, "size",
             fmt::format("{:.4g} x {:.4g} x {:.4g} m", size[0].get<double>(), size[1].get<double>(),
                         size[2].get<double>()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Json& range = report["range_m"][axis];
    append_row(text, fmt::format("  {}", "xyz"[axis]),
               fmt::format("{:.4g} to {:.4g} m", range[0].get<double>(), range[1].get<double>()));
  }
  for (const Json& mesh : report["meshes"]) {
    append_row(
        text, "mesh",
        fmt::format("{}: {} triangles", shown_name(mesh), mesh["triangles"].get<std::size_t>()));
  }
  for (const Json& animation : report["animations"]) {
    append_row(
        text, "animation",
        fmt::format("{}: {:.3f} s", shown_name(animation), animation["duration_s"].get<double>()));
  }
  for (const Json& place : report["places"]) append_row(text, "place", place.get<std::string>());
  for (const Json& warning : report["warnings"]) {
    fmt::format_to(std::back_inserter(text), "\nwarning: {}\n",
                   plain_text(warning.get<std::string>()));
  }
  return text;
}

}  // namespace nade::cli
