#include "object_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "commands.h"
#include "console.h"
#include "nade/io/mesh_file.h"
#include "number_list.h"

namespace nade::cli {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& text,
                         std::string_view expected) {
  throw CLI::ValidationError(option, fmt::format("expected {}, found '{}'", expected, text));
}

void warn_of_placement(const LoadedObject& object, const Placement& placement) {
  for (const std::string& hint :
       {size_hint(object, placement.scale), facing_hint(object, placement.pose.rotation)}) {
    if (!hint.empty()) warn(fmt::format("{}: {}", object.spec, hint));
  }
}

}  // namespace

void add_object_options(CLI::App& command, ObjectOptions& options) {
  command
      .add_option(
          "--object", options.object,
          "plane, sphere, sphere:RADIUS, dog, or a mesh file (.glb .gltf .obj .stl .ply .off); "
          "dog:alive and FILE.glb:alive move as their animation says, FILE.glb:alive:NAME as that")
      ->type_name("OBJECT");
  command
      .add_option_function<std::string>(
          "--at",
          [&options](const std::string& text) {
            const auto at = parse_numbers<3>(text);
            if (!at) refuse("--at", text, "three numbers X,Y,Z");
            options.at = Vec3(at->data());
          },
          "where the object's origin is, metres")
      ->type_name("X,Y,Z");
  command
      .add_option_function<std::string>(
          "--turn",
          [&options](const std::string& text) {
            const auto turn = parse_numbers<4>(text);
            const Quat rotation = turn ? Quat(turn->data()) : Quat(0.0, 0.0, 0.0, 0.0);
            if (!(rotation.norm() > 1e-6)) {
              refuse("--turn", text, "four numbers QX,QY,QZ,QW, not all 0");
            }
            options.turn = rotation.normalized();
          },
          "how the object is turned, a quaternion")
      ->type_name("QX,QY,QZ,QW");
  command
      .add_option_function<std::string>(
          "--scale",
          [&options](const std::string& text) {
            const auto scale = parse_numbers<1>(text);
            if (!scale || !(scale->front() > 0.0)) refuse("--scale", text, "a number above 0");
            options.scale = scale->front();
          },
          "how many times larger the object is")
      ->type_name("S");
}

NamedFile object_file(const ObjectOptions& options) {
  NamedFile file{"--object", options.object};
  if (file.path) file.path->erase(std::min(file.path->find(":alive"), file.path->size()));
  if (file.path && !has_mesh_ending(*file.path)) file.path.reset();
  return file;
}

Result<PlacedObject> load_placed(const ObjectOptions& options,
                                 const std::optional<ObjectPlacing>& recorded) {
  const bool same = recorded && (!options.object ||
                                 object_name(*options.object) == object_name(recorded->object));
  if (!options.object && !recorded) {
    return misuse("--object is required: plane, sphere, sphere:RADIUS, dog or a mesh file");
  }
  Result<LoadedObject> loaded = load_object(options.object ? *options.object : recorded->object);
  if (!loaded && !options.object && loaded.error().code == ErrorCode::not_found) {
    return Error{ErrorCode::not_found,
                 fmt::format("{} beside the recording or here; --object says where it is",
                             loaded.error().message)};
  }
  if (!loaded) return loaded.error();
  for (const std::string& warning : loaded->warnings) {
    warn(warning);
  }
  Placement placement = same ? recorded->placement : Placement{};
  if (options.at) placement.pose.position = *options.at;
  if (options.turn) placement.pose.rotation = *options.turn;
  if (options.scale) placement.scale = *options.scale;
  warn_of_placement(*loaded, placement);
  PlacedObject placed{std::move(loaded).value(), placement};
  if (same) placed.animation_start_ns = recorded->animation_start_ns;
  return placed;
}

void PlacedObject::start_animation(std::int64_t first_ns) {
  if (loaded.animation && !animation_start_ns) animation_start_ns = first_ns;
}

void PlacedObject::move_to(std::int64_t time_ns) {
  start_animation(time_ns);
  if (animation_start_ns) loaded.move_to(1e-9 * static_cast<double>(time_ns - *animation_start_ns));
}

}  // namespace nade::cli
