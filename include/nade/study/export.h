#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "nade/status.h"

namespace nade::study {

/// What an export wrote.
struct StudyExport {
  std::size_t participants = 0;
  std::size_t answers = 0;
  std::size_t motions = 0;  ///< trials whose motion is in it
};

/// Writes a study for others: `OUT/answers.csv`, a tidy table of the answers that count, and
/// `OUT/bids`, the motion as BIDS has it (version 1.9: sub-P01/motion/…_motion.tsv with its
/// channels; the corrected hands under derivatives/nade). `OUT` may not be there yet, or be empty.
/// A damaged study is refused: the error names file and line.
[[nodiscard]] Result<StudyExport> export_study(
    const std::string& folder, const std::string& out,
    const std::function<void(const std::string& participant)>& on_participant = {});

}  // namespace nade::study
