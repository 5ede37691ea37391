#include "nade/study/study_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>

#include "nade/study/participant.h"
#include "natural_order.h"
#include "participant_folder.h"

namespace nade::study {
namespace {

constexpr std::array<std::string_view, 3> kObjects{"plane", "sphere", "dog"};
constexpr std::array<std::string_view, 3> kMethods{"none", "paper", "nade"};

/// Each name once: those that have an order of their own in it, the others after them by name.
std::vector<std::string> in_order(std::vector<std::string> names,
                                  std::span<const std::string_view> known) {
  const auto rank = [known](const std::string& name) {
    const std::string_view kind = std::string_view(name).substr(0, name.find(':'));
    return std::find(known.begin(), known.end(), kind) - known.begin();
  };
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::stable_sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
    return rank(a) != rank(b) ? rank(a) < rank(b) : natural_less(a, b);
  });
  return names;
}

std::vector<std::string> names_of(const std::vector<GivenAnswer>& answers,
                                  std::string GivenAnswer::*name) {
  std::vector<std::string> names;
  std::transform(answers.begin(), answers.end(), std::back_inserter(names),
                 [name](const GivenAnswer& answer) { return answer.*name; });
  return names;
}

void use_plan(StudyData& data) {
  if (!data.plan) return;
  data.questions = data.plan->questions;
  data.scale_high = data.plan->scale.points;
}

/// A table alone does not say what its scale was: a longer one shows by its answers.
Status check_scale(StudyData& data) {
  for (const GivenAnswer& answer : data.answers) {
    if (!answer.value || (*answer.value >= data.scale_low && *answer.value <= data.scale_high)) {
      continue;
    }
    if (data.plan) {
      return Error{ErrorCode::bad_value,
                   fmt::format("{}: line {} of {}'s answers: expected an answer from {:g} to {:g}, "
                               "found {:g}",
                               data.source, answer.line, answer.participant, data.scale_low,
                               data.scale_high, *answer.value)};
    }
    data.scale_low = std::min(data.scale_low, std::floor(*answer.value));
    data.scale_high = std::max(data.scale_high, std::ceil(*answer.value));
  }
  return ok_status();
}

/// Everything that the answers themselves tell.
Status take_stock(StudyData& data) {
  for (std::string& name : names_of(data.answers, &GivenAnswer::participant)) {
    data.participants.push_back(std::move(name));
  }
  data.participants = in_order(std::move(data.participants), {});
  data.objects = in_order(names_of(data.answers, &GivenAnswer::object), kObjects);
  data.methods = in_order(names_of(data.answers, &GivenAnswer::method), kMethods);
  use_plan(data);
  for (const std::string& id : in_order(names_of(data.answers, &GivenAnswer::question), {})) {
    const bool known = std::any_of(data.questions.begin(), data.questions.end(),
                                   [&](const Question& question) { return question.id == id; });
    if (!known) data.questions.push_back({id, {}});
  }
  data.simulated =
      data.simulated || std::any_of(data.answers.begin(), data.answers.end(),
                                    [](const GivenAnswer& answer) { return answer.simulated; });
  if (data.answers.empty()) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: expected answers, found none", data.source)};
  }
  return check_scale(data);
}

Status add_table(const std::string& path, StudyData& data) {
  Result<AnswerTable> table = read_answer_table(path);
  if (table) table = counting_answers(std::move(table).value());
  if (!table) return table.error();
  data.answers = std::move(table->answers);
  data.warnings = std::move(table->warnings);
  return ok_status();
}

/// A study's folder, or one participant's alone.
Status add_folder(const std::string& path, StudyData& data) {
  std::error_code aside;
  if (std::filesystem::exists(std::filesystem::path(path) / kPlanFile, aside)) {
    // The folder's own name is the participant's, however it was asked for ("P01/", ".").
    return add_participant(std::filesystem::canonical(path, aside).string(), data);
  }
  const Result<std::vector<std::string>> folders = participant_folders(path);
  if (!folders) return folders.error();
  for (const std::string& folder : *folders) {
    const Status added = add_participant(folder, data);
    if (!added) return added;
  }
  return ok_status();
}

}  // namespace

Result<StudyData> read_study_data(const std::string& path,
                                  const std::optional<std::string>& plan_path) {
  StudyData data;
  data.source = path;
  if (plan_path) {
    Result<Plan> plan = read_plan(*plan_path);
    if (!plan) return plan.error();
    data.plan = std::move(plan).value();
  }
  std::error_code aside;
  const bool folder = std::filesystem::is_directory(path, aside);
  const Status added = folder ? add_folder(path, data) : add_table(path, data);
  if (!added) return added.error();
  const Status complete = take_stock(data);
  if (!complete) return complete.error();
  return data;
}

}  // namespace nade::study
