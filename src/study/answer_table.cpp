#include "nade/study/answer_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "csv_table.h"

namespace nade::study {
namespace {

/// Where each column of interest is.
struct Columns {
  std::size_t participant = 0;
  std::size_t object = 0;
  std::size_t method = 0;
  std::size_t question = 0;
  std::size_t answer = 0;
  std::optional<std::size_t> trial;
  std::optional<std::size_t> order;
  std::optional<std::size_t> response_time;
  std::optional<std::size_t> attempt;
  std::optional<std::size_t> status;
  std::optional<std::size_t> simulated;
};

Result<Columns> find_columns(const CsvTable& table) {
  Columns columns;
  struct Wanted {
    std::string_view name;
    std::size_t* place;
  };
  for (const Wanted& wanted :
       {Wanted{"participant", &columns.participant}, Wanted{"object", &columns.object},
        Wanted{"method", &columns.method}, Wanted{"question", &columns.question},
        Wanted{"answer", &columns.answer}}) {
    const auto found = table.column(wanted.name);
    if (!found) {
      return Error{ErrorCode::bad_format,
                   fmt::format("{}: line 1: expected a column '{}', found {}", table.path,
                               wanted.name, fmt::join(table.columns, ", "))};
    }
    *wanted.place = *found;
  }
  columns.trial = table.column("trial");
  columns.order = table.column("order");
  columns.response_time = table.column("response_time_s");
  columns.attempt = table.column("attempt");
  columns.status = table.column("status");
  columns.simulated = table.column("simulated");
  return columns;
}

/// A text that says there is nothing.
bool is_missing(std::string_view text) {
  return text.empty() || text == "NA" || text == "NaN" || text == "-";
}

bool is_mark(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  });
  constexpr std::array<std::string_view, 7> kNot{"", "0", "no", "false", "na", "-", "n"};
  return std::find(kNot.begin(), kNot.end(), text) == kNot.end();
}

/// One row, read field by field; the first thing that is wrong is kept.
class GivenAnswerReader {
 public:
  GivenAnswerReader(const CsvTable& table, const CsvRecord& record)
      : table_(table), record_(record) {}

  std::string name(std::size_t column) {
    const std::string& text = record_.fields[column];
    if (text.empty()) fail(column, "a name");
    return text;
  }

  template <class Number>
  std::optional<Number> number(std::optional<std::size_t> column, std::string_view expected) {
    if (!column || is_missing(record_.fields[*column])) return std::nullopt;
    const std::string& text = record_.fields[*column];
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool finite = std::isfinite(static_cast<double>(value));
    if (error != std::errc{} || end != text.data() + text.size() || !finite) {
      fail(*column, expected);
    }
    return value;
  }

  [[nodiscard]] const std::string& text(std::size_t column) const { return record_.fields[column]; }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  void fail(std::size_t column, std::string_view expected) {
    if (error_) return;
    error_ =
        Error{ErrorCode::bad_value,
              fmt::format("{}: line {}: {}: expected {}, found '{}'", table_.path, record_.line,
                          table_.columns[column], expected, record_.fields[column])};
  }

  const CsvTable& table_;
  const CsvRecord& record_;
  std::optional<Error> error_;
};

Result<GivenAnswer> read_row(const CsvTable& table, const CsvRecord& record,
                             const Columns& columns) {
  GivenAnswerReader row(table, record);
  GivenAnswer answer;
  answer.participant = row.name(columns.participant);
  answer.object = row.name(columns.object);
  answer.method = row.name(columns.method);
  answer.question = row.name(columns.question);
  answer.value = row.number<double>(columns.answer, "a number");
  answer.trial = row.number<std::size_t>(columns.trial, "a whole number");
  answer.order = row.number<std::size_t>(columns.order, "a whole number");
  answer.response_time_s = row.number<double>(columns.response_time, "seconds");
  answer.attempt = row.number<std::size_t>(columns.attempt, "a whole number").value_or(1);
  answer.changed = columns.status && row.text(*columns.status) == "changed";
  answer.simulated = columns.simulated && is_mark(row.text(*columns.simulated));
  answer.line = record.line;
  if (row.error()) return *row.error();
  return answer;
}

/// What a person answered questions about.
struct Condition {
  std::string participant;
  std::string object;
  std::string method;
  friend bool operator<(const Condition& a, const Condition& b) {
    return std::tie(a.participant, a.object, a.method) <
           std::tie(b.participant, b.object, b.method);
  }
};

/// A person's attempts at one condition; in each, the row that counts of each question.
using Attempts = std::map<std::size_t, std::map<std::string, const GivenAnswer*>>;

/// Whether it is the last one that tells everything, or the last at all where none does.
const std::map<std::string, const GivenAnswer*>& counting_attempt(const Attempts& attempts,
                                                                  std::size_t questions) {
  const auto whole = std::find_if(attempts.rbegin(), attempts.rend(), [&](const auto& attempt) {
    return attempt.second.size() == questions;
  });
  return (whole == attempts.rend() ? attempts.rbegin() : whole)->second;
}

}  // namespace

Result<AnswerTable> read_answer_table(const std::string& path) {
  Result<CsvTable> table = read_csv(path);
  if (!table) return table.error();
  const Result<Columns> columns = find_columns(*table);
  if (!columns) return columns.error();
  AnswerTable answers;
  answers.path = path;
  answers.warnings = std::move(table->warnings);
  for (const CsvRecord& record : table->records) {
    Result<GivenAnswer> answer = read_row(*table, record, *columns);
    if (!answer) return answer.error();
    answers.answers.push_back(std::move(answer).value());
  }
  return answers;
}

Result<AnswerTable> counting_answers(AnswerTable table) {
  std::map<Condition, Attempts> conditions;
  std::set<std::string> questions;
  for (const GivenAnswer& answer : table.answers) {
    questions.insert(answer.question);
    Attempts& attempts = conditions[{answer.participant, answer.object, answer.method}];
    const GivenAnswer*& kept = attempts[answer.attempt][answer.question];
    if (kept != nullptr && !answer.changed) {
      return Error{ErrorCode::bad_value,
                   fmt::format("{}: line {}: expected one answer of {} to {} of {} with {}, found "
                               "another in line {}",
                               table.path, answer.line, answer.participant, answer.question,
                               answer.object, answer.method, kept->line)};
    }
    kept = &answer;
  }
  std::vector<GivenAnswer> counting;
  for (const auto& [condition, attempts] : conditions) {
    for (const auto& [question, answer] : counting_attempt(attempts, questions.size())) {
      counting.push_back(*answer);
    }
  }
  std::sort(counting.begin(), counting.end(),
            [](const GivenAnswer& a, const GivenAnswer& b) { return a.line < b.line; });
  table.answers = std::move(counting);
  return table;
}

}  // namespace nade::study
