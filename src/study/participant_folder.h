#pragma once

#include <string>

#include "nade/status.h"
#include "nade/study/study_data.h"

namespace nade::study {

/// Adds what a participant's folder holds: answers that count, their recordings, skipped trials,
/// and the plan where `data` has none yet. Damage is refused; the error names file and line.
[[nodiscard]] Status add_participant(const std::string& folder, StudyData& data);

}  // namespace nade::study
