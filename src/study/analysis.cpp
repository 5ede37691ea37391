#include "nade/study/analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "nade/study/statistics.h"

namespace nade::study {
namespace {

/// Which answer: participant, question, object, method.
struct AnswerKey {
  std::string participant;
  std::string question;
  std::string object;
  std::string method;
  friend bool operator<(const AnswerKey& a, const AnswerKey& b) {
    return std::tie(a.participant, a.question, a.object, a.method) <
           std::tie(b.participant, b.question, b.object, b.method);
  }
};
using Answers = std::map<AnswerKey, double>;

/// A person's answers under baseline and method.
struct Pair {
  double baseline = 0.0;
  double method = 0.0;
  double difference = 0.0;
};

Answers index_answers(const StudyData& data) {
  Answers answers;
  for (const GivenAnswer& answer : data.answers) {
    if (!answer.value) continue;
    answers[{answer.participant, answer.question, answer.object, answer.method}] = *answer.value;
  }
  return answers;
}

/// Averages are compared by their sums, rounded: what is the same must be a tie.
double difference_of(double baseline_sum, double method_sum, double count) {
  return std::round((method_sum - baseline_sum) / count * 1e9) * 1e-9;
}

/// A person's pair averaged over objects; no value where an answer is missing.
std::optional<Pair> pair_of(const Answers& answers, const std::string& participant,
                            const std::string& question, std::span<const std::string> objects,
                            const std::string& baseline, const std::string& method) {
  Pair sums;
  for (const std::string& object : objects) {
    const auto before = answers.find({participant, question, object, baseline});
    const auto after = answers.find({participant, question, object, method});
    if (before == answers.end() || after == answers.end()) return std::nullopt;
    sums.baseline += before->second;
    sums.method += after->second;
  }
  const auto count = static_cast<double>(objects.size());
  return Pair{sums.baseline / count, sums.method / count,
              difference_of(sums.baseline, sums.method, count)};
}

Quartiles quartiles(std::span<const double> values) {
  return {quantile(values, 0.25), quantile(values, 0.5), quantile(values, 0.75)};
}

double p_of(const SignedRankTest& test) {
  return test.p_exact ? *test.p_exact : test.p_corrected.value_or(1.0);
}

Comparison compare(std::span<const Pair> pairs, const BootstrapOptions& bootstrap) {
  std::vector<double> before;
  std::vector<double> after;
  std::vector<double> differences;
  for (const Pair& pair : pairs) {
    before.push_back(pair.baseline);
    after.push_back(pair.method);
    differences.push_back(pair.difference);
  }
  Comparison comparison;
  comparison.baseline_answers = quartiles(before);
  comparison.method_answers = quartiles(after);
  comparison.dropped = signed_rank(differences, ZeroDifferences::dropped);
  comparison.pratt = signed_rank(differences, ZeroDifferences::pratt);
  comparison.effect_interval = rank_biserial_interval(differences, bootstrap).value_or(Interval{});
  comparison.p = p_of(comparison.dropped);
  return comparison;
}

void adjust(std::vector<Comparison>& family) {
  std::vector<double> dropped;
  std::vector<double> pratt;
  for (const Comparison& comparison : family) {
    dropped.push_back(comparison.p);
    pratt.push_back(p_of(comparison.pratt));
  }
  dropped = holm(dropped);
  pratt = holm(pratt);
  for (std::size_t i = 0; i < family.size(); ++i) {
    family[i].p_holm = dropped[i];
    family[i].p_holm_pratt = pratt[i];
  }
}

/// Compares each other method with the baseline, over the objects given, question by question.
void compare_all(const StudyData& data, const Answers& answers, const AnalysisOptions& options,
                 std::span<const std::string> objects, const std::string& name,
                 std::vector<Comparison>& family) {
  for (const Question& question : data.questions) {
    for (const std::string& method : data.methods) {
      if (method == options.baseline) continue;
      std::vector<Pair> pairs;
      for (const std::string& participant : data.participants) {
        const auto pair =
            pair_of(answers, participant, question.id, objects, options.baseline, method);
        if (pair) pairs.push_back(*pair);
      }
      if (pairs.empty()) continue;
      Comparison comparison = compare(pairs, options.bootstrap);
      comparison.question = question.id;
      comparison.object = name;
      comparison.method = method;
      family.push_back(std::move(comparison));
    }
  }
}

std::string reason_of(const StudyData& data, const MissingAnswers& missing) {
  for (const SkippedTrial& skipped : data.skipped) {
    if (skipped.participant == missing.participant && skipped.object == missing.object &&
        skipped.method == missing.method) {
      return skipped.why.empty() ? "skipped" : "skipped: " + skipped.why;
    }
  }
  return missing.questions.size() == data.questions.size() ? "no answers" : "left open";
}

/// Conditions that nobody answered are no part of the study.
bool is_answered(const StudyData& data, const std::string& object, const std::string& method) {
  return std::any_of(data.answers.begin(), data.answers.end(), [&](const GivenAnswer& answer) {
    return answer.object == object && answer.method == method && answer.value;
  });
}

/// What one participant did not answer of one condition; no questions where nothing is missing.
MissingAnswers missing_of(const StudyData& data, const Answers& answers,
                          const std::string& participant, const std::string& object,
                          const std::string& method) {
  MissingAnswers missing{participant, object, method, {}, {}};
  for (const Question& question : data.questions) {
    if (answers.contains({participant, question.id, object, method})) continue;
    missing.questions.push_back(question.id);
  }
  missing.why = reason_of(data, missing);
  return missing;
}

std::vector<MissingAnswers> find_missing(const StudyData& data, const Answers& answers) {
  std::vector<MissingAnswers> all;
  for (const std::string& object : data.objects) {
    for (const std::string& method : data.methods) {
      if (!is_answered(data, object, method)) continue;
      for (const std::string& participant : data.participants) {
        MissingAnswers missing = missing_of(data, answers, participant, object, method);
        if (!missing.questions.empty()) all.push_back(std::move(missing));
      }
    }
  }
  std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) {
    return std::find(data.participants.begin(), data.participants.end(), a.participant) <
           std::find(data.participants.begin(), data.participants.end(), b.participant);
  });
  return all;
}

Status check_methods(const StudyData& data, const std::string& baseline) {
  const auto& methods = data.methods;
  const bool has_baseline = std::find(methods.begin(), methods.end(), baseline) != methods.end();
  if (has_baseline && methods.size() > 1) return ok_status();
  return Error{ErrorCode::bad_value,
               fmt::format("{}: expected answers with the method '{}' and with another, found {}",
                           data.source, baseline,
                           methods.empty() ? "no answers"
                                           : fmt::format("'{}'", fmt::join(methods, "', '")))};
}

}  // namespace

Result<Analysis> analyse(const StudyData& data, const AnalysisOptions& options) {
  const Status comparable = check_methods(data, options.baseline);
  if (!comparable) return comparable.error();
  const Answers answers = index_answers(data);
  Analysis analysis;
  analysis.methods = data.methods;
  std::stable_partition(analysis.methods.begin(), analysis.methods.end(),
                        [&](const std::string& method) { return method == options.baseline; });
  compare_all(data, answers, options, data.objects, {}, analysis.averaged);
  for (const std::string& object : data.objects) {
    compare_all(data, answers, options, std::span(&object, 1), object, analysis.by_object);
  }
  if (analysis.by_object.empty()) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: expected somebody's answers to one question with '{}' and with "
                             "another method, found nobody's",
                             data.source, options.baseline)};
  }
  adjust(analysis.averaged);
  adjust(analysis.by_object);
  analysis.missing = find_missing(data, answers);
  return analysis;
}

std::vector<double> answers_to(const StudyData& data, const std::string& question,
                               const std::string& method, const std::string& object) {
  std::vector<double> values;
  for (const GivenAnswer& answer : data.answers) {
    if (answer.question != question || answer.method != method || !answer.value) continue;
    if (object.empty() || answer.object == object) values.push_back(*answer.value);
  }
  return values;
}

}  // namespace nade::study
