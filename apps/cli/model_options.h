#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "nade/mesh.h"
#include "object_options.h"

namespace nade::cli {

/// How a recording is written as a .glb: --flat, --with-object.
struct ModelChoice {
  bool flat = false;
  bool with_object = false;
};

void add_model_choice(CLI::App& command, ModelChoice& choice);

/// An object as triangles in the world, to be shown: a ball of flat faces, a piece of the plane, a
/// mesh as it is at the moment.
[[nodiscard]] std::shared_ptr<const TriangleSoup> shown_object(const PlacedObject& placed);

}  // namespace nade::cli
