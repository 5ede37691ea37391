#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace nade::cli {

/// A name on the command line, and what it stands for.
template <class T>
struct Choice {
  const char* name;
  T value;
};

/// The names of some choices, parted by |.
template <class T>
std::string names_of(const std::vector<Choice<T>>& choices) {
  std::string names;
  for (const Choice<T>& choice : choices) {
    names += fmt::format("{}{}", names.empty() ? "" : "|", choice.name);
  }
  return names;
}

/// An option that takes one of a few names. `Value` is a T, or an optional one.
template <class T, class Value>
CLI::Option* add_choice(CLI::App& command, const std::string& name, Value& value,
                        const std::vector<Choice<T>>& choices, const std::string& help) {
  const std::string names = names_of(choices);
  return command
      .add_option_function<std::string>(
          name,
          [=, &value](const std::string& text) {
            for (const Choice<T>& choice : choices) {
              if (text == choice.name) {
                value = choice.value;
                return;
              }
            }
            throw CLI::ValidationError(name, fmt::format("expected {}, found '{}'", names, text));
          },
          help)
      ->type_name(names);
}

}  // namespace nade::cli
