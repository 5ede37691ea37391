#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "nade/eval/compare.h"
#include "nade/eval/scene.h"
#include "nade/status.h"

namespace nade::cli {

/// The methods of a list of names, parted by commas; all that this program was built with where
/// there is none. The error lists those there are.
[[nodiscard]] Result<std::vector<ComparedMethod>> chosen_methods(std::string_view names);

/// The default method's numbers with those set that a list of "name=value" names. The error says
/// which there are, or what range a number has.
[[nodiscard]] Result<std::shared_ptr<const ProxyTuning>> tuning_with(
    const std::vector<std::string>& settings);

/// The default method's numbers as a Markdown table, for docs/method.md.
[[nodiscard]] std::string tuning_as_markdown();

/// The scenes of a folder; those that come with nade for an empty name, none for "none".
[[nodiscard]] Result<std::vector<std::shared_ptr<const BenchScene>>> chosen_scenes(
    const std::string& folder);

}  // namespace nade::cli
