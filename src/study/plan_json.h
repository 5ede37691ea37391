#pragma once

#include "json_reader.h"
#include "nade/study/plan.h"

namespace nade::study {

/// A plan from its JSON; what is wrong goes to the reader's error.
[[nodiscard]] Plan plan_from(const JsonReader& json);
[[nodiscard]] Json json_of(const Plan& plan);

}  // namespace nade::study
