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

/// A method by its name on the command line, and all the names, parted by |.
[[nodiscard]] std::optional<Method> method_from_name(std::string_view name);
[[nodiscard]] std::string method_names();

/// A method's name, or "paper_literal".
[[nodiscard]] std::string method_name(const MethodOptions& options);

}  // namespace nade::cli
