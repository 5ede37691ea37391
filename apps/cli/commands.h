#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <utility>

#include "nade/status.h"

namespace nade::cli {

/// What the command line asked for: runs it and says how it went.
using Action = std::function<Status()>;

/// Options that do not go together, or that ask for what there is not.
[[nodiscard]] inline Error misuse(std::string sentence) {
  return {ErrorCode::out_of_range, std::move(sentence)};
}

/// Each adds one subcommand; when it is parsed, `action` becomes what it does.
void add_bench(CLI::App& app, Action& action);
void add_convert(CLI::App& app, Action& action);
void add_correct(CLI::App& app, Action& action);
void add_figure(CLI::App& app, Action& action);
void add_inspect(CLI::App& app, Action& action);
void add_measure(CLI::App& app, Action& action);
void add_render(CLI::App& app, Action& action);
void add_study(CLI::App& app, Action& action);
void add_synth(CLI::App& app, Action& action);
void add_view(CLI::App& app, Action& action);
void add_xr(CLI::App& app, Action& action);

/// A part of `nade study`.
void add_study_analyse(CLI::App& study, Action& action);

}  // namespace nade::cli
