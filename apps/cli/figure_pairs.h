#pragma once

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
  std::vector<SuiteCase> cases;         ///< to be drawn from
  std::vector<ComparedMethod> methods;  ///< two
  std::size_t count = 40;               ///< of pairs, each of another case as long as there are any
  std::uint64_t seed = 1;               ///< of cases, moments and which is left
  std::string folder;
};

/// Draws pairs of pictures of the same moment by two methods, for people who do not know which is
/// which: `pair_001.png` and so on, `index.html` to answer in, `answers.csv` to fill in by hand,
/// and `key.csv`, which says what is what. Moments are those in which the tracked hand presses; a
/// case without any is passed over.
[[nodiscard]] Status draw_pairs(const PairsPlan& plan, const DrawnHands& hands, Studio& studio);

}  // namespace nade::cli
