#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nade/io/mesh_file.h"
#include "nade/status.h"
#include "nade/surface.h"

namespace nade {

/// An object by its name on the command line, and everything that goes with it. The object's own
/// frame is the one that a placement moves: the plane is y = 0, the sphere has its top at the
/// origin, a mesh is as in its file.
struct LoadedObject {
  std::string spec;                   ///< what was asked for: "plane", "sphere:0.06", "dog.glb"
  std::unique_ptr<Surface> surface;   ///< in its own coordinates; `base` takes them to the object's
  Placement base;                     ///< e.g. puts a ball about the origin under it
  std::vector<MeshPlace> places;      ///< where to stroke it, in the object's frame; never empty
  std::optional<TriangleSoup> soup;   ///< in the object's frame; only where it is a mesh
  std::vector<std::string> warnings;  ///< what was odd about the mesh, a sentence each

  /// The object as it stands in the world. Holds on to `surface`.
  [[nodiscard]] Object placed(const Placement& placement = {}) const;

  /// A place by name; without a name the one called "back", or else the first. The error lists
  /// the places there are.
  [[nodiscard]] Result<MeshPlace> place(std::string_view name = {}) const;
};

/// Loads `plane`, `sphere`, `sphere:RADIUS`, `dog` or a mesh file. A name that cannot be any of
/// these, or a radius that is not above 0, is `ErrorCode::out_of_range`. An object without places
/// of its own gets one, "top": for a mesh, where a ray down through its centroid first meets it.
[[nodiscard]] Result<LoadedObject> load_object(const std::string& spec);

/// Which object stood where: what the header of a recording keeps of it.
struct ObjectPlacing {
  std::string object;
  Placement placement;
};

/// `json_object` with the keys "object", "at", "turn" and "scale" set; an empty text counts as {}.
/// Its text has to be a JSON object.
[[nodiscard]] std::string with_placing(const std::string& json_object,
                                       const ObjectPlacing& placing);

/// The placing in a header's `unknown_json`; no value where it names no object. Absent "at",
/// "turn" and "scale" mean none. `name` is what the error calls the recording.
[[nodiscard]] Result<std::optional<ObjectPlacing>> placing_from(const std::string& json_object,
                                                                const std::string& name);

/// First `inner`, then `outer`.
[[nodiscard]] Placement composed(const Placement& outer, const Placement& inner);

}  // namespace nade
