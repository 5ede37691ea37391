#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nade/draw/image.h"
#include "nade/draw/stage.h"
#include "show.h"

namespace nade::cli {

/// One hand-frame of a row of the figure: an object, and what each method makes of the hands.
struct FigureRow {
  std::string title;  ///< "Plane"
  double air = 0.87;  ///< of the picture about the hand; 1 has more of the object in it
  PlacedObject placed;
  /// The same moment by each method, in the order of the columns.
  std::vector<draw::StagedHands> by_method;
};

/// What the points of the last column are called.
enum class FigureTerms : std::uint8_t {
  rays,  ///< the paper's: rays from parts to the surface
  skin,  ///< skin that is kept out, wherever it is
};

struct FigureContent {
  std::vector<std::string> methods;  ///< names for the columns
  std::size_t explained = 0;         ///< which of them the last column explains
  FigureTerms terms = FigureTerms::skin;
  std::vector<FigureRow> rows;
  std::string caption;  ///< what was stroked, and how
};

/// The sheet: a row for each object; the object, the hand without correction, with it, and the
/// correction explained. 3840 pixels wide.
[[nodiscard]] Result<draw::Image> draw_figure(const FigureContent& content, Studio& studio);

}  // namespace nade::cli
