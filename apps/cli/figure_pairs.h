#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "nade/eval/compare.h"
#include "nade/eval/suite.h"
#include "nade/status.h"
#include "show.h"

namespace nade::cli {

/// Which pictures are asked about.
struct PairsPlan {
  std::vector<SuiteCase> cases;  ///< to be drawn from
  std::array<ComparedMethod, 2> methods;
  std::size_t count = 40;  ///< of pairs, each of another case as long as there are any
  std::uint64_t seed = 1;  ///< of cases, moments and which is left
  double film_s = 0.0;     ///< above 0: so much of the time around each moment is filmed, too
  std::string folder;
};

/// Draws pairs of pictures of the same moment by two methods, for people who do not know which is
/// which: `pair_001.png` and so on, films of the same names if asked for, `index.html` to answer
/// in, `answers.csv` to fill in by hand, and `key.csv`, which says what is what. Moments are those
/// in which the tracked hand presses; a case without any is passed over.
[[nodiscard]] Status draw_pairs(const PairsPlan& plan, const DrawnHands& hands, Studio& studio);

}  // namespace nade::cli
