#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench_report.h"
#include "nade/eval/compare.h"
#include "nade/eval/suite.h"
#include "nade/status.h"

namespace nade::cli {

/// What is to be compared, on what.
struct BenchPlan {
  std::vector<SuiteCase> cases;
  std::vector<ComparedMethod> methods;
  std::size_t jobs = 1;  ///< cases worked on at a time, at least 1
};

/// Corrects and measures every case by every method. All but the times is the same whatever the
/// number of jobs. The error names the case.
[[nodiscard]] Result<BenchReport> run_bench(const BenchPlan& plan, const DrawnHands& hands);

/// Writes, for every figure's worst case of every method, the tracked and all corrected recordings
/// into a folder of the case's own under `folder`, with the object's mesh where it is no file, and
/// `worst.txt`, which says whose worst it is.
[[nodiscard]] Status dump_worst(const BenchPlan& plan, const DrawnHands& hands,
                                const BenchReport& report, const std::string& folder);

}  // namespace nade::cli
