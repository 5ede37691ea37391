#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <string_view>

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
[[nodiscard]] CorrectorOptions options_of(const MethodOptions& options);

/// All methods' names, parted by |.
[[nodiscard]] std::string method_names();

/// A method's name, or "paper_literal".
[[nodiscard]] std::string method_name(const MethodOptions& options);

}  // namespace nade::cli
