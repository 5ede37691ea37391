#include "bvh_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <utility>
#include <vector>

#include "mesh_words.h"

namespace nade::io {
namespace {

using NameWords = std::vector<std::string>;

bool is_capital(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_small(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }
bool is_figure(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// "mixamorig:LeftHandIndex1" is left, hand, index, 1; "LThumb" is l, thumb.
NameWords words_of_name(std::string_view name) {
  name.remove_prefix(std::min(name.size(), name.rfind(':') + 1));
  NameWords words;
  std::string word;
  const auto finish = [&] {
    if (!word.empty()) words.push_back(std::exchange(word, {}));
  };
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (!is_capital(c) && !is_small(c) && !is_figure(c)) {
      finish();
      continue;
    }
    if (!word.empty()) {
      const char before = name[i - 1];
      const bool next_is_small = i + 1 < name.size() && is_small(name[i + 1]);
      if (is_figure(c) != is_figure(before) ||
          (is_capital(c) && (!is_capital(before) || next_is_small))) {
        finish();
      }
    }
    word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  finish();
  return words;
}

bool has_word(const NameWords& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool begins_a_part(std::string_view word) {
  constexpr std::array<std::string_view, 9> kParts{"hand", "wrist", "thumb",  "index", "mid",
                                                   "ring", "pink",  "little", "finger"};
  return std::any_of(kParts.begin(), kParts.end(),
                     [&](std::string_view part) { return word.starts_with(part); });
}

std::optional<Handedness> side_of_words(const NameWords& words) {
  for (const std::string& word : words) {
    if (word.starts_with("left")) return Handedness::left;
    if (word.starts_with("right")) return Handedness::right;
  }
  for (const std::string& word : words) {
    if (word != "l" && word != "r" && !begins_a_part(std::string_view(word).substr(1))) continue;
    if (word[0] == 'l') return Handedness::left;
    if (word[0] == 'r') return Handedness::right;
  }
  return std::nullopt;
}

std::optional<Digit> digit_of_words(const NameWords& words) {
  constexpr std::array<std::pair<std::string_view, Digit>, 7> kDigits{{{"thumb", Digit::thumb},
                                                                       {"index", Digit::index},
                                                                       {"mid", Digit::middle},
                                                                       {"ring", Digit::ring},
                                                                       {"pink", Digit::little},
                                                                       {"little", Digit::little},
                                                                       {"small", Digit::little}}};
  for (const std::string& word : words) {
    for (const auto& [part, digit] : kDigits) {
      if (word.find(part) != std::string::npos) return digit;
    }
  }
  return std::nullopt;
}

/// "finger 01" of 3ds Max is the second bone of digit 0, "second pp" of Xsens a bone of the second.
std::optional<std::size_t> digit_number_of_words(const NameWords& words) {
  constexpr std::array<std::string_view, kDigitCount> kOrdinals{"first", "second", "third",
                                                                "fourth", "fifth"};
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto ordinal = std::find(kOrdinals.begin(), kOrdinals.end(), words[i]);
    if (ordinal != kOrdinals.end()) {
      return static_cast<std::size_t>(ordinal - kOrdinals.begin()) + 1;
    }
    const bool counted = words[i].ends_with("finger") || words[i].ends_with("digit");
    if (!counted || i + 1 == words.size() || !is_figure(words[i + 1][0])) continue;
    return static_cast<std::size_t>(words[i + 1][0] - '0');
  }
  return std::nullopt;
}

}  // namespace

BvhName bvh_name_from(std::string_view name) {
  const NameWords words = words_of_name(name);
  BvhName result;
  for (const std::string& word : words) {
    // Toes have the fingers' names.
    if (word.find("toe") != std::string::npos || word.find("foot") != std::string::npos) return {};
    std::size_t number = 0;
    if (parse_word(word, number)) result.number = number;
  }
  result.side = side_of_words(words);
  result.digit = digit_of_words(words);
  if (!result.digit) result.digit_number = digit_number_of_words(words);
  const auto ends = [&](std::string_view part) {
    return std::any_of(words.begin(), words.end(),
                       [&](const std::string& word) { return word.ends_with(part); });
  };
  result.is_metacarpal = ends("metacarpal") || ends("meta") || has_word(words, "mc") ||
                         (has_word(words, "in") && has_word(words, "hand"));
  result.is_wrist = ends("hand") || ends("wrist");
  result.is_palm = ends("palm") || ends("carpus");
  return result;
}

}  // namespace nade::io
