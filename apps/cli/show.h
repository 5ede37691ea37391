#pragma once

#include <memory>
#include <optional>
#include <string>

#include "method_options.h"
#include "nade/draw/gl_context.h"
#include "nade/draw/renderer.h"
#include "nade/draw/stage.h"
#include "object_options.h"
#include "performance.h"
#include "picture_options.h"

namespace nade::cli {

/// What is to be shown, as the command line says it.
struct ShowArguments {
  std::string recording;
  std::optional<std::string> corrected;
  ObjectOptions object;
  MethodOptions method;
  std::optional<double> press_m;
  HandFiles hands;
};
void add_show_options(CLI::App& command, ShowArguments& arguments);

/// Refuses to draw over anything that is shown.
[[nodiscard]] Status check_apart(const std::string& output, const ShowArguments& arguments);

/// All that is known before the first picture.
struct Show {
  draw::HandMeshes hands;
  Survey survey;
  PlacedObject placed;
  Performance performance;
  double softness_m = 0.0;  ///< of the object, as asked or as the header says
  bool has_tracked = true;  ///< not where a corrected recording stands alone
};

/// Reads hands, recording and object; the object stands as asked, as the recording's header says,
/// or pressed against the palms. The error names what could not be read.
[[nodiscard]] Result<Show> prepare(const ShowArguments& arguments);

/// A place to take pictures without a display.
struct Studio {
  draw::OffscreenContext context;
  std::unique_ptr<draw::Renderer> renderer;
  draw::Stage stage;
};
[[nodiscard]] Result<Studio> open_studio(const draw::HandMeshes& hands);

/// Puts an object onto the stage; what of it cannot be shown goes to stderr.
[[nodiscard]] Status set_object(Studio& studio, const PlacedObject& placed);

}  // namespace nade::cli
