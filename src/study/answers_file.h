#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "nade/study/participant.h"

namespace nade::study {

/// A whole line of a file, without its end.
struct FileLine {
  std::size_t number = 1;
  std::string text;
};

/// The whole lines of a file of the participant's. A last line that was cut off is left out and the
/// file noted among `cut_files`; a file that cannot be read is a problem.
[[nodiscard]] std::vector<FileLine> read_lines(const std::string& path, Participant& participant);

/// Reads answers.csv; whatever the plan does not allow is a problem.
void read_answers(Participant& participant);

}  // namespace nade::study
