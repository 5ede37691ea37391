#include "bench_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "commands.h"
#include "nade/io/assets.h"
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
      std::string expected;
      for (const ComparedMethod& method : known) {
        expected += (expected.empty() ? "" : ", ") + method.name;
      }
      return misuse(fmt::format("--method '{}': expected some of {}", name, expected));
    }
    const bool again = std::any_of(chosen.begin(), chosen.end(), [&](const ComparedMethod& method) {
      return method.name == name;
    });
    if (!again) chosen.push_back(*found);
    if (end == names.size()) return chosen;
    names.remove_prefix(end + 1);
  }
}

Result<std::vector<std::shared_ptr<const Scene>>> chosen_scenes(const std::string& folder) {
  if (folder == "none") return std::vector<std::shared_ptr<const Scene>>{};
  if (!folder.empty()) return read_scenes(folder);
  const Result<std::string> own = find_asset("scenes");
  if (!own) return own.error();
  return read_scenes(*own);
}

}  // namespace nade::cli
