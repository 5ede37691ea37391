#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "commands.h"
#include "nade/status.h"
#include "nade/study/run.h"

namespace nade::cli {

/// What `nade study run` was asked.
struct StudyRunArguments {
  std::string plan;
  std::string participant;
  std::optional<std::string> folder;  ///< of the study; else beside the plan, by its name
  std::optional<std::string> language;
  double speed = 1.0;  ///< of the study's time against life's
  // Of the headset:
  bool mirror = false;                   ///< a window for the operator
  std::optional<std::string> panel_log;  ///< what the panel shows, for programs
};

/// Where a study's hands come from.
struct HandSource {
  std::string name;  ///< "mouse", "openxr"
  bool scale_known = false;
};

/// Reads the plan and begins the participant's study, or goes on with it. What was mended goes to
/// stderr.
[[nodiscard]] Result<std::unique_ptr<study::StudyRun>> open_study(
    const StudyRunArguments& arguments, const HandSource& source);

/// What remains to be said when a run has ended, of which `shown` tells whether it could be shown.
/// Of one that could not even begin nothing is kept.
[[nodiscard]] Status close_study(const Status& shown, study::StudyRun& run);

/// The study in a headset, where this was built with OpenXR; else the error says so.
[[nodiscard]] Status run_study_in_headset(const StudyRunArguments& arguments);

/// `nade study run`.
void add_study_run(CLI::App& study, Action& action);

}  // namespace nade::cli
