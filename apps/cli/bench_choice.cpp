#include "bench_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "commands.h"
#include "nade/io/assets.h"
#include "proxy/tuning.h"
#ifdef NADE_CLI_PHYSICS
#include "physics_hand.h"
#endif

namespace nade::cli {
namespace {

/// All that this program was built with, in the order in which they are reported.
std::vector<ComparedMethod> all_methods() {
  std::vector<ComparedMethod> methods = library_methods();
#ifdef NADE_CLI_PHYSICS
  methods.push_back(physics_method());
#endif
  return methods;
}

template <class Named>
std::vector<std::string_view> names_of(const Named& all) {
  std::vector<std::string_view> names;
  names.reserve(all.size());
  for (const auto& each : all) names.emplace_back(each.name);
  return names;
}

}  // namespace

Result<std::vector<ComparedMethod>> chosen_methods(std::string_view names) {
  std::vector<ComparedMethod> known = all_methods();
  if (names.empty()) return known;
  std::vector<ComparedMethod> chosen;
  while (true) {
    const std::size_t end = std::min(names.find(','), names.size());
    const std::string_view name = names.substr(0, end);
    const auto found = std::find_if(known.begin(), known.end(), [&](const ComparedMethod& method) {
      return method.name == name;
    });
    if (found == known.end()) {
      return misuse(fmt::format("--method '{}': expected some of {}", name,
                                fmt::join(names_of(known), ", ")));
    }
    const bool again = std::any_of(chosen.begin(), chosen.end(), [&](const ComparedMethod& method) {
      return method.name == name;
    });
    if (!again) chosen.push_back(*found);
    if (end == names.size()) return chosen;
    names.remove_prefix(end + 1);
  }
}

Result<std::shared_ptr<const ProxyTuning>> tuning_with(const std::vector<std::string>& settings) {
  ProxyTuning tuning;
  for (const std::string& setting : settings) {
    const std::size_t equals = std::min(setting.find('='), setting.size());
    const std::string_view name = std::string_view(setting).substr(0, equals);
    const auto table = tuning_table();
    const auto info = std::find_if(table.begin(), table.end(),
                                   [&](const TuningInfo& each) { return each.name == name; });
    if (info == table.end()) {
      return misuse(fmt::format("--set '{}': expected NAME=VALUE, NAME one of {}", setting,
                                fmt::join(names_of(table), ", ")));
    }
    double value = 0.0;
    const char* const from = setting.data() + std::min(equals + 1, setting.size());
    const char* const end = setting.data() + setting.size();
    const auto read = std::from_chars(from, end, value);
    if (read.ec != std::errc() || read.ptr != end ||
        !(value >= info->least && value <= info->most)) {
      return misuse(fmt::format("--set '{}': expected a number from {:g} to {:g}", setting,
                                info->least, info->most));
    }
    tuning.*(info->value) = value;
  }
  return std::make_shared<const ProxyTuning>(tuning);
}

std::string tuning_as_markdown() {
  std::string text = "| number | value | unit | range | why |\n|---|--:|---|---|---|\n";
  const ProxyTuning tuning;
  for (const TuningInfo& info : tuning_table()) {
    text += fmt::format("| `{}` | {:g} | {} | {:g} to {:g} | {} |\n", info.name,
                        tuning.*(info.value), info.unit, info.least, info.most, info.why);
  }
  return text;
}

Result<std::vector<std::shared_ptr<const BenchScene>>> chosen_scenes(const std::string& folder) {
  if (folder == "none") return std::vector<std::shared_ptr<const BenchScene>>{};
  if (!folder.empty()) return read_scenes(folder);
  const Result<std::string> own = find_asset("scenes");
  if (!own) return own.error();
  return read_scenes(*own);
}

}  // namespace nade::cli
