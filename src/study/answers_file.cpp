#include "answers_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

#include "json_reader.h"

namespace nade::study {
namespace {

constexpr std::string_view kColumns =
    "participant,trial,order,object,method,question,answer,response_time_s,attempt,status";
constexpr std::string_view kSimulatedColumn = ",simulated";
constexpr std::string_view kSimulated = "SIMULATED";
constexpr std::size_t kFields = 10;

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

template <class Number>
std::optional<Number> number_from(std::string_view text) {
  Number number{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// One row against the plan: what it says, or what is wrong with it.
class KeptAnswerReader {
 public:
  KeptAnswerReader(const ParticipantPlan& head, std::string_view line)
      : head_(head), fields_(split(line)) {}

  std::optional<KeptAnswer> read() {
    const bool simulated = head_.origin == Origin::simulated;
    const std::size_t expected = kFields + (simulated ? 1 : 0);
    if (fields_.size() != expected) {
      problem_ = fmt::format("expected {} fields, found {}", expected, fields_.size());
      return std::nullopt;
    }
    KeptAnswer row;
    row.participant = fields_[0];
    if (row.participant != head_.participant) fail(0, "participant", head_.participant);
    row.trial = whole(1, "trial", 1, head_.trials.size());
    row.order = whole(2, "order", 1, head_.trials.size());
    row.object = fields_[3];
    row.method = fields_[4];
    row.question = fields_[5];
    if (!problem_.empty()) return std::nullopt;
    const Trial& trial = head_.trials[row.trial - 1];
    if (row.object != trial.object) fail(3, "object", trial.object);
    if (row.method != name_of(trial.method)) fail(4, "method", name_of(trial.method));
    const auto& questions = head_.plan.questions;
    if (std::none_of(questions.begin(), questions.end(),
                     [&](const Question& question) { return question.id == row.question; })) {
      fail(5, "question", "one of the plan's");
    }
    row.answer =
        static_cast<int>(whole(6, "answer", 1, static_cast<std::size_t>(head_.plan.scale.points)));
    const auto time_s = number_from<double>(fields_[7]);
    if (!time_s || !(*time_s >= 0.0) || *time_s > 1e6) fail(7, "response_time_s", "seconds");
    row.response_time_s = time_s.value_or(0.0);
    row.attempt = whole(8, "attempt", 1, 1000);
    if (fields_[9] != "given" && fields_[9] != "changed") fail(9, "status", "given or changed");
    row.changed = fields_[9] == "changed";
    if (simulated && fields_[10] != kSimulated) fail(10, "simulated", kSimulated);
    if (!problem_.empty()) return std::nullopt;
    return row;
  }
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  void fail(std::size_t field, std::string_view name, std::string_view expected) {
    if (!problem_.empty()) return;
    problem_ = fmt::format("{}: expected {}, found '{}'", name, expected, fields_[field]);
  }
  std::size_t whole(std::size_t field, std::string_view name, std::size_t low, std::size_t high) {
    const auto number = number_from<std::size_t>(fields_[field]);
    if (number && *number >= low && *number <= high) return *number;
    fail(field, name, fmt::format("{} to {}", low, high));
    return low;
  }

  const ParticipantPlan& head_;
  std::vector<std::string_view> fields_;
  std::string problem_;
};

bool same_place(const KeptAnswer& a, const KeptAnswer& b) {
  return a.trial == b.trial && a.attempt == b.attempt && a.question == b.question;
}

}  // namespace

std::string answers_header(Origin origin) {
  return fmt::format("{}{}\n", kColumns, origin == Origin::simulated ? kSimulatedColumn : "");
}

std::string answers_line(const KeptAnswer& row, Origin origin) {
  return fmt::format("{},{},{},{},{},{},{},{:.3f},{},{}{}\n", row.participant, row.trial, row.order,
                     row.object, row.method, row.question, row.answer, row.response_time_s,
                     row.attempt, row.changed ? "changed" : "given",
                     origin == Origin::simulated ? fmt::format(",{}", kSimulated) : "");
}

std::vector<FileLine> read_lines(const std::string& path, Participant& participant) {
  const Result<std::string> content = read_text(path, "a file of the study");
  std::vector<FileLine> lines;
  if (!content) {
    participant.problems.push_back(content.error().message);
    return lines;
  }
  std::string_view rest = *content;
  while (!rest.empty()) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) {
      participant.cut_files.push_back(path);
      break;
    }
    lines.push_back({lines.size() + 1, std::string(rest.substr(0, end))});
    rest.remove_prefix(end + 1);
  }
  return lines;
}

void read_answers(Participant& participant) {
  const std::string path = fmt::format("{}/{}", participant.folder, kAnswersFile);
  const std::vector<FileLine> lines = read_lines(path, participant);
  const std::string header = answers_header(participant.head.origin);
  const std::string_view names = std::string_view(header).substr(0, header.size() - 1);
  if (!lines.empty() && lines.front().text != names) {
    participant.problems.push_back(fmt::format("{}: line 1: expected the columns {}, found '{}'",
                                               path, names, lines.front().text));
    return;
  }
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto complain = [&](std::string_view what) {
      participant.problems.push_back(fmt::format("{}: line {}: {}", path, lines[i].number, what));
    };
    KeptAnswerReader reader(participant.head, lines[i].text);
    const std::optional<KeptAnswer> row = reader.read();
    if (!row) {
      complain(reader.problem());
      continue;
    }
    const bool again =
        std::any_of(participant.answers.begin(), participant.answers.end(),
                    [&](const KeptAnswer& earlier) { return same_place(earlier, *row); });
    if (again && !row->changed) {
      complain(fmt::format("expected one given answer to {} of trial {}, found a second",
                           row->question, row->trial));
    }
    if (!again && row->changed) {
      complain(fmt::format("expected a given answer to {} of trial {} before it was changed",
                           row->question, row->trial));
    }
    participant.answers.push_back(*row);
  }
}

}  // namespace nade::study
