#pragma once

#include <string>
#include <vector>

#include "nade/status.h"
#include "nade/study/study_data.h"

namespace nade::study {

/// Whether a folder is a participant's.
[[nodiscard]] bool is_participant_folder(const std::string& path);

/// Adds what a participant's folder holds: answers that count, recordings, skipped trials, and the
/// plan where `data` has none yet. The error names file and place.
[[nodiscard]] Status add_participant(const std::string& path, StudyData& data);

}  // namespace nade::study
