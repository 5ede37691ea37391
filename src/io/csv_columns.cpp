#include "csv_columns.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>
#include <vector>

namespace nade::io {
namespace {

bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_letter_or_digit(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Its words in small letters: parted by what is no letter or digit, and where a capital follows a
/// small letter.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words(1);
  char before = '_';
  for (const char c : name) {
    const bool parts = !is_letter_or_digit(c) || (is_upper(c) && !is_upper(before));
    if (parts && !words.back().empty()) words.emplace_back();
    if (is_letter_or_digit(c)) {
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    before = c;
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

/// Takes the side off the front of a word; nothing may be left of it then.
std::optional<Handedness> take_side(std::string& word, bool is_first) {
  constexpr std::array<std::pair<std::string_view, Handedness>, 2> kSides{
      {{"left", Handedness::left}, {"right", Handedness::right}}};
  for (const auto& [name, side] : kSides) {
    if (word.starts_with(name)) {
      word.erase(0, name.size());
      return side;
    }
    if (is_first && word == name.substr(0, 1)) {
      word.clear();
      return side;
    }
  }
  return std::nullopt;
}

/// Of the words of a name only what tells columns apart, in one.
std::string told_by(const std::vector<std::string>& words) {
  constexpr std::array<std::string_view, 9> kNoise{"xr",     "xrhand",  "hand",     "joint", "ext",
                                                   "finger", "phalanx", "phalange", "bone"};
  std::string told;
  std::string_view before;
  for (const std::string& word : words) {
    // An "id" by itself may be anything's.
    const bool of_joint = word == "id" && before == "joint";
    if (!of_joint && std::find(kNoise.begin(), kNoise.end(), word) == kNoise.end()) told += word;
    before = word;
  }
  return told;
}

std::string squeezed(Joint joint) {
  std::string name(name_of(joint));
  std::erase(name, '_');
  return name;
}

/// Takes a joint's name off the front; WebXR's little finger is "pinky".
std::optional<Joint> take_joint(std::string& told) {
  if (told.starts_with("pinky")) told.replace(0, 5, "little");
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const std::string name = squeezed(joint_at(i));
    if (!told.starts_with(name)) continue;
    told.erase(0, name.size());
    return joint_at(i);
  }
  return std::nullopt;
}

std::optional<std::size_t> number_from(std::string_view told) {
  constexpr std::array<std::string_view, 6> kPosition{"",         "p", "pos",
                                                      "position", "t", "translation"};
  constexpr std::array<std::string_view, 7> kRotation{"q", "quat",     "quaternion", "rot",
                                                      "r", "rotation", "orientation"};
  if (told == "radius" || told == "r") return 7;
  if (told.empty()) return std::nullopt;
  const std::string_view axes = "xyzw";
  const std::size_t axis = axes.find(told.back());
  told.remove_suffix(1);
  if (axis == std::string_view::npos) return std::nullopt;
  const auto is_one_of = [&](const auto& names) {
    return std::find(names.begin(), names.end(), told) != names.end();
  };
  if (is_one_of(kRotation) || (axis == 3 && told.empty())) return 3 + axis;
  if (axis < 3 && is_one_of(kPosition)) return axis;
  return std::nullopt;
}

std::optional<double> time_unit_from(std::string told) {
  constexpr std::array<std::pair<std::string_view, double>, 9> kUnits{{{"nanoseconds", 1.0},
                                                                       {"ns", 1.0},
                                                                       {"microseconds", 1e3},
                                                                       {"us", 1e3},
                                                                       {"milliseconds", 1e6},
                                                                       {"ms", 1e6},
                                                                       {"seconds", 1e9},
                                                                       {"sec", 1e9},
                                                                       {"s", 1e9}}};
  double unit_ns = 0.0;
  for (const auto& [name, nanoseconds] : kUnits) {
    if (!told.ends_with(name) || (told.size() == name.size() && name.size() < 3)) continue;
    // "timestamps" has no unit.
    if (name == "s" && told.ends_with("stamps")) continue;
    told.erase(told.size() - name.size());
    unit_ns = nanoseconds;
    break;
  }
  for (const std::string_view name : {"time", "timestamp", "t", "", "displaytime", "frametime"}) {
    if (told == name && (unit_ns > 0.0 || !name.empty())) return unit_ns;
  }
  return std::nullopt;
}

}  // namespace

std::optional<JointColumn> column_from(std::string_view name) {
  std::vector<std::string> words = words_of(name);
  JointColumn column;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (const auto side = take_side(words[i], i == 0 && words.size() > 2)) column.side = side;
  }
  std::string told = told_by(words);
  if (const std::optional<Joint> joint = take_joint(told)) {
    const std::optional<std::size_t> number = number_from(told);
    if (!number) return std::nullopt;
    column.joint = *joint;
    column.number = *number;
    return column;
  }
  if (told.empty() || told == "handedness" || told == "edness" || told == "side") {
    if (words.empty() || column.side) return std::nullopt;
    column.kind = JointColumn::Kind::side;
    return column;
  }
  if (told == "valid" || told == "isvalid" || told == "tracked" || told == "istracked" ||
      told == "active" || told == "isactive") {
    column.kind = JointColumn::Kind::valid;
    return column;
  }
  if (told == "confidence") {
    column.kind = JointColumn::Kind::confidence;
    return column;
  }
  const std::optional<double> unit_ns = time_unit_from(told);
  if (!unit_ns) return std::nullopt;
  column.kind = JointColumn::Kind::time;
  column.time_unit_ns = *unit_ns;
  return column;
}

}  // namespace nade::io
