#include "nade/study/line_break.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace nade::study {
namespace {

enum class Kind : std::uint8_t { blank, zero_width, opening, closing, stop, hiragana, wide, other };

struct Character {
  std::string_view text;
  Kind kind = Kind::other;
};

constexpr std::string_view kZeroWidthSpace = "\u200B";
constexpr unsigned char kFirstWideLead = 0xE3;  // of U+3000 and above: kana and ideographs

bool is_one_of(std::string_view character, std::string_view all) {
  return all.find(character) != std::string_view::npos;
}

Kind kind_of(std::string_view character) {
  if (character == " " || character == "\u3000") return Kind::blank;
  if (character == kZeroWidthSpace) return Kind::zero_width;
  if (is_one_of(character, "「『（【〔《(")) return Kind::opening;
  if (is_one_of(character, "。、！？，．")) return Kind::stop;
  if (is_one_of(character, "」』）】〕》・ーァィゥェォッャュョぁぃぅぇぉっゃゅょ々…)!?,.:;")) {
    return Kind::closing;
  }
  if (character >= "ぁ" && character <= "ゟ") return Kind::hiragana;
  return static_cast<unsigned char>(character.front()) >= kFirstWideLead ? Kind::wide : Kind::other;
}

std::vector<Character> characters_of(std::string_view text) {
  std::vector<Character> characters;
  while (!text.empty()) {
    std::size_t bytes = 1;
    while (bytes < text.size() && (static_cast<unsigned char>(text[bytes]) & 0xC0U) == 0x80U) {
      ++bytes;
    }
    characters.push_back({text.substr(0, bytes), kind_of(text.substr(0, bytes))});
    text.remove_prefix(bytes);
  }
  return characters;
}

/// Whether a line may end between two characters where it has to.
bool may_part(const Character& before, const Character& after) {
  return before.kind != Kind::opening && after.kind != Kind::closing && after.kind != Kind::stop;
}

/// Whether a phrase ends between them. In Japanese most begin with a character that is no kana and
/// end with kana.
bool parts_phrases(const Character& before, const Character& after) {
  if (!may_part(before, after)) return false;
  if (before.kind == Kind::stop || after.kind == Kind::opening) return true;
  const bool is_prefix = before.text == "お" || before.text == "ご";
  const bool ends = before.kind == Kind::hiragana || is_one_of(before.text, "」』）");
  return ends && !is_prefix && after.kind == Kind::wide;
}

/// Puts pieces of text into lines.
class Lines {
 public:
  Lines(double room, const TextWidth& width) : room_(room), width_(width) {}

  void add(std::string_view piece) {
    if (fits(piece)) {
      lines_.back() += piece;
      return;
    }
    end_line();
    for (const Character& character : characters_of(piece)) {
      const bool full = !lines_.back().empty() && !fits(character.text);
      if (full && may_part(last_, character)) end_line();
      lines_.back() += character.text;
      last_ = character;
    }
  }
  void end_line() {
    trim();
    if (!lines_.back().empty()) lines_.emplace_back();
  }
  void feed() {
    trim();
    lines_.emplace_back();
  }
  std::vector<std::string> take() {
    trim();
    return std::move(lines_);
  }

 private:
  [[nodiscard]] bool fits(std::string_view piece) const {
    std::string line = lines_.back() + std::string(piece);
    line.erase(line.find_last_not_of(' ') + 1);
    return width_(line) <= room_;
  }
  void trim() { lines_.back().erase(lines_.back().find_last_not_of(' ') + 1); }

  double room_;
  const TextWidth& width_;
  std::vector<std::string> lines_ = std::vector<std::string>(1);
  Character last_;
};

}  // namespace

std::vector<std::string> broken_lines(std::string_view utf8, double room, const TextWidth& width) {
  const bool is_marked = utf8.find(kZeroWidthSpace) != std::string_view::npos;
  const std::vector<Character> characters = characters_of(utf8);
  Lines lines(room, width);
  std::string piece;
  for (std::size_t i = 0; i < characters.size(); ++i) {
    const Character& character = characters[i];
    const bool is_feed = character.text == "\n";
    if (!is_feed && character.kind != Kind::zero_width) piece += character.text;
    const bool last = i + 1 == characters.size();
    const bool ends = last || is_feed || character.kind == Kind::blank ||
                      character.kind == Kind::zero_width ||
                      (!is_marked && parts_phrases(character, characters[i + 1]));
    if (!ends) continue;
    lines.add(piece);
    piece.clear();
    if (is_feed) lines.feed();
  }
  return lines.take();
}

}  // namespace nade::study
