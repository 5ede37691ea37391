#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nade/corrector.h"
#include "nade/status.h"
#include "nade/study/order.h"

namespace nade::study {

enum class Language : std::uint8_t { english, japanese };

/// The same words in each language of a study, UTF-8.
struct Text {
  std::string english;
  std::string japanese;

  /// In the other language where there is none in this one.
  [[nodiscard]] const std::string& in(Language language) const;
  friend bool operator==(const Text&, const Text&) = default;
};

/// What is stroked.
struct StudyObject {
  std::string name;  ///< in files and tables: letters, digits, - and _
  std::string spec;  ///< as `load_object` takes it; a file is found from the plan's folder
  friend bool operator==(const StudyObject&, const StudyObject&) = default;
};

/// Answers go from 1 to `points`.
struct Scale {
  int points = 7;  ///< 2 to 11
  Text low;        ///< what 1 means
  Text high;       ///< what the last one means
  friend bool operator==(const Scale&, const Scale&) = default;
};

struct Question {
  std::string id;  ///< "Q1": letters, digits, - and _
  Text text;
  friend bool operator==(const Question&, const Question&) = default;
};

/// A trial before the others whose answers are not kept.
struct Practice {
  std::string object;  ///< by its name
  Method method = Method::none;
  double duration_s = 20.0;  ///< 1 to 600
  friend bool operator==(const Practice&, const Practice&) = default;
};

struct Rest {
  std::size_t after_trials = 3;  ///< every so many, > 0
  double at_least_s = 20.0;      ///< 0 to 3600
  friend bool operator==(const Rest&, const Rest&) = default;
};

/// A study: every object is stroked under every method, then the questions are asked.
struct Plan {
  std::string title;
  std::uint64_t seed = 0;
  Language language = Language::english;
  OrderKind order = OrderKind::random;
  std::vector<StudyObject> objects;
  std::vector<Method> methods;
  double trial_s = 30.0;     ///< 1 to 3600
  double countdown_s = 3.0;  ///< before the stroking of each trial, 0 to 60
  std::optional<Practice> practice;
  std::optional<Rest> rest;
  std::vector<Question> questions;
  Scale scale;
  std::vector<Text> instructions;  ///< paragraphs
  Text thanks;
  friend bool operator==(const Plan&, const Plan&) = default;
};

/// The paper's experiment: plane, sphere and dog, each without correction and with `corrected`,
/// 30 s each, in random order, Q1 to Q3 on 7 points after each.
[[nodiscard]] Plan default_plan(Method corrected = Method::paper);

/// Reads a plan. The error names the file, the place in it ("questions[1].text.en") and what was
/// expected there; keys that a plan does not have are refused.
[[nodiscard]] Result<Plan> read_plan(const std::string& path);
[[nodiscard]] Result<Plan> parse_plan(std::string_view text, const std::string& name);
/// As JSON, which `parse_plan` reads back to the same plan.
[[nodiscard]] std::string plan_text(const Plan& plan);

/// The first key in which two plans differ ("trial_s"); empty where they are the same.
[[nodiscard]] std::string difference_of(const Plan& a, const Plan& b);

/// A condition at its place in a participant's order.
struct Trial {
  std::size_t number = 1;  ///< from 1; 0 is the practice
  std::string object;      ///< by its name
  Method method = Method::none;
  friend bool operator==(const Trial&, const Trial&) = default;
};

/// A participant's trials in their order.
[[nodiscard]] std::vector<Trial> trials_of(const Plan& plan, std::string_view participant);

/// The object of a name; null where the plan has none.
[[nodiscard]] const StudyObject* find_object(const Plan& plan, std::string_view name);

/// Whether a text may name a participant, an object or a question: 1 to 40 letters (of ASCII),
/// digits, - and _.
[[nodiscard]] bool is_identifier(std::string_view text);

}  // namespace nade::study
