#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "nade/corrector.h"
#include "nade/status.h"

namespace nade::cli {

/// --method, and the open points of the paper as options of their own.
struct MethodOptions {
  CorrectorOptions corrector;
  bool literal = false;
  const CLI::App* command = nullptr;  ///< that they were added to, and which knows what was given
};

/// Adds the options to a command. What cannot be read is refused while parsing.
void add_method_options(CLI::App& command, MethodOptions& options);

/// Whether the person can change the method while the program runs.
enum class MethodChange : std::uint8_t { never, any_time };

/// Refuses what has no effect with the method that was asked for, or overrides it.
[[nodiscard]] Status check_method(const MethodOptions& options, MethodChange change);

/// The first option that was given of those that say how to correct; no value where none was. The
/// object's softness is not one of them: it also says how far the drawn object gives way.
[[nodiscard]] std::optional<std::string> given_of(const MethodOptions& options);

/// What to make correctors with.
[[nodiscard]] CorrectorOptions options_of(const MethodOptions& options);

/// All methods' names, parted by |.
[[nodiscard]] std::string method_names();

/// A method's name, or "paper_literal".
[[nodiscard]] std::string method_name(const MethodOptions& options);

}  // namespace nade::cli
