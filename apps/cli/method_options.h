#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "nade/corrector.h"

namespace nade::cli {

/// --method, and the open points of the paper as options of their own.
struct MethodOptions {
  CorrectorOptions corrector;
  bool literal = false;
};

/// Adds the options to a command. What cannot be read is refused while parsing.
void add_method_options(CLI::App& command, MethodOptions& options);

/// What to make correctors with.
[[nodiscard]] const CorrectorOptions& options_of(const MethodOptions& options);

/// "none", "paper", or "paper_literal".
[[nodiscard]] std::string method_name(const MethodOptions& options);

}  // namespace nade::cli
