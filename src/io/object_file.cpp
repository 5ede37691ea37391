#include "nade/io/object_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "nade/io/assets.h"
#include "nade/mesh.h"

namespace nade {
namespace {

constexpr double kDefaultRadius = 0.15;
constexpr std::string_view kSpherePrefix = "sphere:";
constexpr std::string_view kAlive = ":alive";

Error misuse(std::string message) { return {ErrorCode::out_of_range, std::move(message)}; }

MeshPlace top_place(const Vec3& point, const Vec3& normal) {
  // -Z, the way of the stroke, is the world's as far as the surface allows.
  Vec3 back = Vec3::UnitZ() - normal * normal.z();
  if (back.norm() < 1e-6) back = Vec3::UnitY() - normal * normal.y();
  back.normalize();
  Eigen::Matrix3d axes;
  axes << normal.cross(back), normal, back;
  return {"top", {point, Quat(axes)}};
}

LoadedObject make_plane(const std::string& spec) {
  LoadedObject object;
  object.spec = spec;
  object.surface = std::make_unique<PlaneSurface>();
  object.places.push_back(top_place(Vec3::Zero(), Vec3::UnitY()));
  return object;
}

LoadedObject make_sphere(const std::string& spec, double radius_m) {
  LoadedObject object;
  object.spec = spec;
  object.surface = std::make_unique<SphereSurface>(radius_m);
  object.base.pose.position = Vec3(0.0, -radius_m, 0.0);
  object.places.push_back(top_place(Vec3::Zero(), Vec3::UnitY()));
  return object;
}

Result<LoadedObject> make_sized_sphere(const std::string& spec) {
  const char* const first = spec.data() + kSpherePrefix.size();
  const char* const last = spec.data() + spec.size();
  double radius_m = 0.0;
  const auto [end, code] = std::from_chars(first, last, radius_m);
  if (code != std::errc{} || end != last || !std::isfinite(radius_m) || radius_m <= 0.0) {
    return misuse(
        fmt::format("object {}: expected a radius above 0 in metres after 'sphere:'", spec));
  }
  return make_sphere(spec, radius_m);
}

Vec3 area_centroid(const TriangleSoup& soup) {
  Vec3 sum = Vec3::Zero();
  double total = 0.0;
  for (const auto& [i, j, k] : soup.triangles) {
    const Vec3 a = soup.vertices[i].cast<double>();
    const Vec3 b = soup.vertices[j].cast<double>();
    const Vec3 c = soup.vertices[k].cast<double>();
    const double weight = (b - a).cross(c - a).norm();
    sum += weight / 3.0 * (a + b + c);
    total += weight;
  }
  return sum / total;
}

/// Where a ray down through the centroid meets the mesh; beside it, the highest vertex.
MeshPlace top_of(const TriangleSoup& soup, const Surface& surface) {
  const auto highest = std::max_element(
      soup.vertices.begin(), soup.vertices.end(),
      [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) { return a.y() < b.y(); });
  const Vec3 peak = highest->cast<double>();
  const Vec3 centroid = area_centroid(soup);
  const double height = peak.y() - centroid.y();
  Ray down;
  down.origin = Vec3(centroid.x(), peak.y() + 0.1 + height, centroid.z());
  down.direction = -Vec3::UnitY();
  if (const auto hit = surface.first_hit(down)) return top_place(hit->point, hit->normal);
  SurfaceHint hint;
  const auto nearest = surface.closest_point(peak, std::numeric_limits<double>::infinity(), hint);
  return nearest ? top_place(nearest->point, nearest->normal) : top_place(peak, Vec3::UnitY());
}

std::vector<std::string> warnings_about(const MeshReport& report, const std::string& spec) {
  std::vector<std::string> warnings;
  if (report.triangles_degenerate + report.triangles_duplicate > 0) {
    warnings.push_back(fmt::format("{}: {} triangles without area and {} duplicates are left out",
                                   spec, report.triangles_degenerate, report.triangles_duplicate));
  }
  if (report.triangles_turned > 0) {
    warnings.push_back(fmt::format("{}: {} triangles wound against their neighbours are turned",
                                   spec, report.triangles_turned));
  }
  if (report.solid == MeshSolid::defective) {
    warnings.push_back(fmt::format(
        "{}: {} edges with one triangle and {} with more than two: what is inside is told by the "
        "winding number",
        spec, report.border_edges, report.nonmanifold_edges));
  }
  if (report.solid == MeshSolid::sheet) {
    warnings.push_back(
        fmt::format("{}: not closed: taken as a sheet, solid on its back side", spec));
  }
  return warnings;
}

/// Where the triangles of a mesh come from, and what moves them.
struct MeshSource {
  std::string path;
  std::optional<std::string> animation;  ///< by name; empty: the first
};

Result<LoadedObject> make_mesh(const std::string& spec, const MeshSource& source) {
  const std::string& path = source.path;
  Result<MeshFile> file = load_mesh(path);
  if (!file) return file.error();
  std::optional<AnimatedMesh> animation;
  if (source.animation) {
    Result<AnimatedMesh> loaded = AnimatedMesh::load(path, *source.animation);
    if (!loaded) return loaded.error();
    if (loaded->vertex_count() != file->soup.vertices.size()) {
      return Error{ErrorCode::bad_format,
                   fmt::format("{}: expected {} vertices to move, found {}", path,
                               file->soup.vertices.size(), loaded->vertex_count())};
    }
    animation = std::move(loaded).value();
    animation->sample(0.0, file->soup.vertices);
  }
  auto surface = MeshSurface::build(file->soup, path);
  if (!surface) return surface.error();
  LoadedObject object;
  object.spec = spec;
  object.file = path;
  object.warnings = std::move(file->warnings);
  for (std::string& warning : warnings_about((*surface)->report(), spec)) {
    object.warnings.push_back(std::move(warning));
  }
  if (animation && !animation->warning().empty()) object.warnings.push_back(animation->warning());
  object.places = std::move(file->places);
  object.surface = std::move(surface).value();
  if (object.places.empty()) object.places.push_back(top_of(file->soup, *object.surface));
  object.soup = std::move(file->soup);
  object.animation = std::move(animation);
  return object;
}

Result<LoadedObject> load_file(const std::string& spec, std::optional<std::string> animation) {
  const std::string name = spec.substr(0, spec.find(kAlive));
  if (name != "dog") return make_mesh(spec, {name, std::move(animation)});
  const Result<std::string> path = find_asset("dog.glb");
  if (!path) return path.error();
  return make_mesh(spec, {*path, std::move(animation)});
}

/// "dog:alive", "horse.glb:alive:Walk".
Result<LoadedObject> load_alive(const std::string& spec) {
  const std::size_t colon = spec.find(kAlive);
  const std::string name = spec.substr(0, colon);
  const std::string rest = spec.substr(colon + kAlive.size());
  const bool moves = name == "dog" || ending_of(name) == ".glb" || ending_of(name) == ".gltf";
  if (!moves || (!rest.empty() && !rest.starts_with(':'))) {
    return misuse(fmt::format(
        "object '{}': expected dog:alive, or a .glb or .gltf file with ':alive' after it", spec));
  }
  return load_file(spec, rest.empty() ? rest : rest.substr(1));
}

/// `count` finite numbers under `key`; no value where there are none.
std::optional<std::vector<double>> numbers(const nlohmann::json& array, std::size_t count) {
  if (!array.is_array() || array.size() != count) return std::nullopt;
  std::vector<double> values;
  for (const auto& element : array) {
    if (!element.is_number() || !std::isfinite(element.get<double>())) return std::nullopt;
    values.push_back(element.get<double>());
  }
  return values;
}

/// The object of a header: beside the recording where it is there, else where the header, as it
/// was written before, has it.
std::string found_object(const std::string& spec, const std::string& recording) {
  const std::string beside =
      (std::filesystem::path(recording).parent_path() / object_name(spec)).string();
  const std::string file = beside.substr(0, beside.find(kAlive));
  std::error_code ignored;
  if (!has_mesh_ending(file) || !std::filesystem::is_regular_file(file, ignored)) return spec;
  return beside;
}

Error bad_key(const std::string& name, std::string_view key, std::string_view expected) {
  return {ErrorCode::bad_value, fmt::format("{}: header: {}: expected {}", name, key, expected)};
}

Result<Placement> placement_from(const nlohmann::json& header, const std::string& name) {
  Placement placement;
  if (header.contains("at")) {
    const auto at = numbers(header["at"], 3);
    if (!at) return bad_key(name, "at", "3 numbers");
    placement.pose.position = Eigen::Map<const Vec3>(at->data());
  }
  if (header.contains("turn")) {
    const auto turn = numbers(header["turn"], 4);
    const Quat rotation = turn ? Quat(turn->data()) : Quat(0, 0, 0, 0);
    if (!(rotation.norm() > 1e-6)) return bad_key(name, "turn", "4 numbers, not all 0");
    placement.pose.rotation = rotation.normalized();
  }
  if (header.contains("scale")) {
    const auto& scale = header["scale"];
    if (!scale.is_number() || !(scale.get<double>() > 0.0)) {
      return bad_key(name, "scale", "a number above 0");
    }
    placement.scale = scale.get<double>();
  }
  return placement;
}

}  // namespace

Placement composed(const Placement& outer, const Placement& inner) {
  return {{outer.to_world(inner.pose.position), outer.pose.rotation * inner.pose.rotation},
          outer.scale * inner.scale};
}

Object LoadedObject::placed(const Placement& placement) const {
  return Object(*surface, composed(placement, base));
}

void LoadedObject::move_to(double time_s) noexcept {
  if (!animation) return;
  animation->sample(time_s, soup->vertices);
  static_cast<MeshSurface&>(*surface).refit(soup->vertices);
}

Result<MeshPlace> LoadedObject::place(std::string_view name) const {
  const std::string_view wanted = name.empty() ? "back" : name;
  for (const MeshPlace& place : places) {
    if (place.name == wanted) return place;
  }
  if (name.empty()) return places.front();
  std::string known;
  for (const MeshPlace& place : places) known += (known.empty() ? "" : ", ") + place.name;
  return misuse(fmt::format("object {}: no place '{}': expected one of {}", spec, name, known));
}

Result<LoadedObject> load_object(const std::string& spec) {
  if (spec == "plane") return make_plane(spec);
  if (spec == "sphere") return make_sphere(spec, kDefaultRadius);
  if (spec.starts_with(kSpherePrefix)) return make_sized_sphere(spec);
  if (spec == "dog") return load_file(spec, std::nullopt);
  if (spec.find(kAlive) != std::string::npos) return load_alive(spec);
  if (spec.find_first_of("./") == std::string::npos) {
    return misuse(fmt::format(
        "object '{}': expected plane, sphere, sphere:RADIUS, dog, dog:alive or a mesh file", spec));
  }
  return make_mesh(spec, {spec, std::nullopt});
}

std::string object_name(const std::string& spec) {
  const std::size_t end = std::min(spec.find(kAlive), spec.size());
  const std::string file = spec.substr(0, end);
  if (!has_mesh_ending(file)) return spec;
  return std::filesystem::path(file).filename().string() + spec.substr(end);
}

std::string size_hint(const LoadedObject& object, double scale) {
  // What a hand strokes is seldom larger or smaller, in metres.
  constexpr double kSmallest = 0.01;
  constexpr double kLargest = 5.0;
  if (!object.soup) return {};
  Eigen::AlignedBox3f bounds;
  for (const Eigen::Vector3f& vertex : object.soup->vertices) bounds.extend(vertex);
  const double size_m = scale * static_cast<double>(bounds.diagonal().norm());
  const auto fits = [](double size) { return size >= kSmallest && size <= kLargest; };
  if (fits(size_m)) return {};
  struct Unit {
    double scale;
    const char* when;
  };
  constexpr std::array<Unit, 6> kUnits{{{0.001, "if its file is in millimetres"},
                                        {0.01, "if in centimetres"},
                                        {0.0254, "if in inches"},
                                        {0.3048, "if in feet"},
                                        {100.0, "if it was made a hundred times too small"},
                                        {1000.0, "if it was made a thousand times too small"}}};
  std::string scales;
  for (const Unit& unit : kUnits) {
    if (!fits(unit.scale * size_m)) continue;
    scales += fmt::format("{}{:.4g} {}", scales.empty() ? "; --scale " : ", ", scale * unit.scale,
                          unit.when);
  }
  return fmt::format("{:.3g} m large{}", size_m, scales);
}

std::string facing_hint(const LoadedObject& object, const Quat& turn) {
  const auto* const mesh = dynamic_cast<const MeshSurface*>(object.surface.get());
  if (mesh == nullptr || mesh->report().solid != MeshSolid::sheet) return {};
  constexpr double kDown = -0.1;
  const Vec3 front = turn * object.place().value().pose.rotation * Vec3::UnitY();
  if (front.y() > kDown) return {};
  const Quat over = Quat(0.0, 1.0, 0.0, 0.0) * turn;
  // Not "-0".
  const Eigen::Vector4d numbers = over.coeffs().array() + 0.0;
  return fmt::format(
      "the sheet's front looks down, so a hand over it counts as behind it and is drawn below; "
      "--turn {:.4g},{:.4g},{:.4g},{:.4g} turns it over, or turn its faces over in a modeller",
      numbers.x(), numbers.y(), numbers.z(), numbers.w());
}

std::string with_placing(const std::string& json_object, const ObjectPlacing& placing) {
  auto header = json_object.empty() ? nlohmann::ordered_json::object()
                                    : nlohmann::ordered_json::parse(json_object, nullptr, false);
  NADE_ASSERT(header.is_object());
  const Pose& pose = placing.placement.pose;
  header["object"] = object_name(placing.object);
  header["at"] = {pose.position.x(), pose.position.y(), pose.position.z()};
  header["turn"] = {pose.rotation.x(), pose.rotation.y(), pose.rotation.z(), pose.rotation.w()};
  header["scale"] = placing.placement.scale;
  header.erase("animation_start");
  if (placing.animation_start_ns) header["animation_start"] = *placing.animation_start_ns;
  return header.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string with_settle(const std::string& json_object, const SettleOptions& settle) {
  auto header = nlohmann::ordered_json::parse(json_object, nullptr, false);
  NADE_ASSERT(header.is_object());
  if (settle.softness_m > 0.0) header["softness"] = settle.softness_m;
  if (settle.friction.coefficient > 0.0) header["friction"] = settle.friction.coefficient;
  return header.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

double softness_from(const std::string& json_object) {
  const auto header = nlohmann::json::parse(json_object, nullptr, false);
  if (!header.is_object() || !header.contains("softness")) return 0.0;
  const auto& softness = header["softness"];
  return softness.is_number() ? std::clamp(softness.get<double>(), 0.0, kSoftest_m) : 0.0;
}

Result<std::optional<ObjectPlacing>> placing_from(const std::string& json_object,
                                                  const std::string& recording) {
  if (json_object.empty()) return std::optional<ObjectPlacing>();
  const auto header = nlohmann::json::parse(json_object, nullptr, false);
  if (!header.is_object() || !header.contains("object")) return std::optional<ObjectPlacing>();
  if (!header["object"].is_string()) return bad_key(recording, "object", "a text");
  const Result<Placement> placement = placement_from(header, recording);
  if (!placement) return placement.error();
  ObjectPlacing placing{
      found_object(header["object"].get<std::string>(), recording), *placement, {}};
  if (header.contains("animation_start")) {
    const auto& start = header["animation_start"];
    if (!start.is_number_integer()) {
      return bad_key(recording, "animation_start", "a whole number of nanoseconds");
    }
    placing.animation_start_ns = start.get<std::int64_t>();
  }
  return std::optional(std::move(placing));
}

}  // namespace nade
