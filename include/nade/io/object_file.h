#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nade/io/animated_mesh.h"
#include "nade/io/mesh_file.h"
#include "nade/settle_options.h"
#include "nade/status.h"
#include "nade/surface.h"

namespace nade {

/// An object by its name on the command line, and everything that goes with it. The object's own
/// frame is the one that a placement moves: the plane is y = 0, the sphere has its top at the
/// origin, a mesh is as in its file.
struct LoadedObject {
  std::string spec;                  ///< what was asked for: "plane", "sphere:0.06", "dog.glb"
  std::string file;                  ///< the mesh file behind it; empty where there is none
  std::unique_ptr<Surface> surface;  ///< in its own coordinates; `base` takes them to the object's
  Placement base;                    ///< e.g. puts a ball about the origin under it
  std::vector<MeshPlace> places;     ///< where to stroke it, in the object's frame; never empty
  /// In the object's frame, as it is at the moment; only where it is a mesh.
  std::optional<TriangleSoup> soup;
  std::optional<AnimatedMesh> animation;  ///< of an object that moves by itself
  std::vector<std::string> warnings;      ///< what was odd about the mesh, a sentence each

  /// The object as it stands in the world. Holds on to `surface`.
  [[nodiscard]] Object placed(const Placement& placement = {}) const;

  /// Lets an object that moves by itself have the shape of a time since its animation's start,
  /// any finite number of seconds: `soup` and `surface` follow. Does not allocate. Not while
  /// another thread queries.
  void move_to(double time_s) noexcept;

  /// A place by name; without a name the one called "back", or else the first. The error lists
  /// the places there are.
  [[nodiscard]] Result<MeshPlace> place(std::string_view name = {}) const;
};

/// Loads `plane`, `sphere`, `sphere:RADIUS`, `dog` or a mesh file; with ":alive" after the dog or a
/// glTF file one that moves as its first animation says, with ":alive:NAME" as that one. A name
/// that cannot be any of these, or a radius that is not above 0, is `ErrorCode::out_of_range`. An
/// object without places of its own gets one, "top": for a mesh, where a ray down through its
/// centroid first meets it.
[[nodiscard]] Result<LoadedObject> load_object(const std::string& spec);

/// What a header calls an object: a mesh file by its name without the folder, so that no one's
/// folders travel with a recording. Anything else stays as it is.
[[nodiscard]] std::string object_name(const std::string& spec);

/// Which object stood where: what the header of a recording keeps of it.
struct ObjectPlacing {
  std::string object;
  Placement placement;
  /// Of an object that moves by itself: the recording's time at its animation's start.
  std::optional<std::int64_t> animation_start_ns{};
};

/// What is odd about a mesh's size beside a hand, and which scales would mend it: "269 m large;
/// --scale 0.001 if its file is in millimetres". Empty where it is 1 cm to 5 m large, at that
/// scale.
[[nodiscard]] std::string size_hint(const LoadedObject& object, double scale);

/// Of a sheet whose front, so turned, looks down: that a hand over it is drawn below, and which
/// `--turn` would mend it. Empty for anything else.
[[nodiscard]] std::string facing_hint(const LoadedObject& object, const Quat& turn);

/// `json_object` with the keys "object" (its `object_name`), "at", "turn", "scale" and, where there
/// is one, "animation_start" set; an empty text counts as {}. Its text has to be a JSON object.
[[nodiscard]] std::string with_placing(const std::string& json_object,
                                       const ObjectPlacing& placing);

/// The placing in a header's `unknown_json`; no value where it names no object. Absent "at",
/// "turn", "scale" and "animation_start" mean none. `recording` is its path: a mesh file is the one
/// beside it, where there is one. The error begins with it.
[[nodiscard]] Result<std::optional<ObjectPlacing>> placing_from(const std::string& json_object,
                                                                const std::string& recording);

/// `json_object` with the keys "softness" and "friction" set, each where it is above 0. Its text
/// has to be a JSON object.
[[nodiscard]] std::string with_settle(const std::string& json_object, const SettleOptions& settle);

/// The softness in a header's `unknown_json`, metres, 0 to `kSoftest_m`; 0 where it says none.
[[nodiscard]] double softness_from(const std::string& json_object);

/// First `inner`, then `outer`.
[[nodiscard]] Placement composed(const Placement& outer, const Placement& inner);

}  // namespace nade
