#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "nade/status.h"
#include "nade/study/signed_rank.h"
#include "nade/study/study_data.h"

namespace nade::study {

struct AnalysisOptions {
  std::string baseline = "none";  ///< the method that each other one is compared with
  BootstrapOptions bootstrap;
};

/// Quartiles by R's type 7.
struct Quartiles {
  double lower = 0.0;
  double median = 0.0;
  double upper = 0.0;
};

/// One question's answers under one method against those under the baseline, paired by person.
struct Comparison {
  std::string question;
  std::string object;  ///< empty: each person's average over all objects
  std::string method;
  Quartiles baseline_answers;  ///< of the pairs that are compared
  Quartiles method_answers;
  SignedRankTest dropped;  ///< of method less baseline
  SignedRankTest pratt;
  Interval effect_interval;  ///< of `dropped.rank_biserial`
  double p = 1.0;            ///< of `dropped`: exact, or corrected beyond kExactPairs
  double p_holm = 1.0;       ///< over the family that the comparison is listed in
  double p_holm_pratt = 1.0;
};

/// What a participant did not answer of one condition.
struct MissingAnswers {
  std::string participant;
  std::string object;
  std::string method;
  std::vector<std::string> questions;
  std::string why;
};

/// What the answers say.
struct Analysis {
  std::vector<std::string> methods;   ///< the baseline first
  std::vector<Comparison> averaged;   ///< a family: questions x methods
  std::vector<Comparison> by_object;  ///< another: questions x objects x methods
  std::vector<MissingAnswers> missing;
};

/// Tests every question. A person without both answers is left out of that comparison, and of the
/// average if any object lacks one; a comparison without pairs is left out. The error says what the
/// data lack, when nothing can be compared.
[[nodiscard]] Result<Analysis> analyse(const StudyData& data, const AnalysisOptions& options = {});

/// Answers of one condition in the data's order: to `question` under `method`, of one object or,
/// where `object` is empty, of all.
[[nodiscard]] std::vector<double> answers_to(const StudyData& data, const std::string& question,
                                             const std::string& method, const std::string& object);

}  // namespace nade::study
