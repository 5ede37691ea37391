#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "command_files.h"
#include "nade/io/object_file.h"
#include "nade/status.h"

namespace nade::cli {

/// Which object, and where: --object, --at, --turn, --scale, as far as they were given.
struct ObjectOptions {
  std::optional<std::string> object;
  std::optional<Vec3> at;
  std::optional<Quat> turn;
  std::optional<double> scale;
};

/// Adds the options to a command. What cannot be read is refused while parsing.
void add_object_options(CLI::App& command, ObjectOptions& options);

/// The file that the object is read from, where it is one.
[[nodiscard]] NamedFile object_file(const ObjectOptions& options);

/// An object, loaded, and where it stands.
struct PlacedObject {
  LoadedObject loaded;
  Placement placement;
  /// Where it moves by itself: the recording's time at its animation's start.
  std::optional<std::int64_t> animation_start_ns{};

  [[nodiscard]] Object object() const { return loaded.placed(placement); }
  [[nodiscard]] ObjectPlacing placing() const {
    return {loaded.spec, placement, animation_start_ns};
  }

  /// Its animation starts with the recording, where nothing else is known.
  void start_animation(std::int64_t first_ns);
  /// Moves it on to a time of the recording, where it moves by itself. The animation starts at
  /// the first such time if not told otherwise.
  void move_to(std::int64_t time_ns);
};

/// Loads the object that was asked for. What the command line leaves open is taken from
/// `recorded`, where that is of the same object or the command line names none. Warnings about
/// the object go to stderr.
[[nodiscard]] Result<PlacedObject> load_placed(const ObjectOptions& options,
                                               const std::optional<ObjectPlacing>& recorded = {});

}  // namespace nade::cli
