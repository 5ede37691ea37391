// A study's plan.
#include <cstddef>
#include <cstdint>

#include "input_file.h"
#include "nade/study/plan.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nade;
  const Result<study::Plan> plan = study::parse_plan(fuzz::text_of(data, size), "input");
  if (!plan) return 0;
  const Result<study::Plan> again = study::parse_plan(study::plan_text(*plan), "its text");
  fuzz::demand(again.ok() && *again == *plan);
  (void)study::trials_of(*plan, "P01");
  return 0;
}
