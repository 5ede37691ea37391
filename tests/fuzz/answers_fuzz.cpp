// A table of everybody's answers, read and analysed.
#include <cstddef>
#include <cstdint>

#include "input_file.h"
#include "nade/study/analysis.h"
#include "nade/study/study_data.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nade;
  const fuzz::InputFile file(fuzz::text_of(data, size), ".csv");
  const Result<study::StudyData> answers = study::read_study_data(file.path());
  if (!answers) return 0;
  study::AnalysisOptions options;
  options.bootstrap.resamples = 20;
  (void)study::analyse(*answers, options);
  return 0;
}
