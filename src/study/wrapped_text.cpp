#include "wrapped_text.h"

#include <algorithm>

namespace nade::study {
namespace {

/// What may not be broken: a word with the blank before it, or a single wide character with the
/// punctuation after it.
struct Piece {
  std::string text;
  std::size_t width = 0;
  bool blank_before = false;
};

constexpr unsigned char kFirstWideLead = 0xE3;  // of U+3000 and above: kana and ideographs

std::size_t character_bytes(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t bytes = lead < 0xC0 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  return std::min(bytes, text.size());
}

/// No line begins with these.
bool ends_a_line(std::string_view character) {
  return character == "。" || character == "、" || character == "？" || character == "」" ||
         character == "）" || character == "ー" || character == "っ" || character == "ょ" ||
         character == "ゃ" || character == "ゅ";
}

std::vector<Piece> pieces_of(std::string_view text) {
  std::vector<Piece> pieces;
  bool blank = false;
  bool joins = false;
  while (!text.empty()) {
    const std::string_view character = text.substr(0, character_bytes(text));
    text.remove_prefix(character.size());
    if (character == " " || character == "\n") {
      blank = true;
      joins = false;
      continue;
    }
    const bool wide = static_cast<unsigned char>(character.front()) >= kFirstWideLead;
    const bool goes_on = !blank && (ends_a_line(character) || (joins && !wide));
    if (pieces.empty() || !goes_on) pieces.push_back({{}, 0, blank});
    pieces.back().text += character;
    pieces.back().width += wide ? 2 : 1;
    blank = false;
    joins = !wide;
  }
  return pieces;
}

}  // namespace

std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  std::size_t filled = 0;
  for (const Piece& piece : pieces_of(text)) {
    const std::size_t blank = piece.blank_before ? 1 : 0;
    if (lines.empty() || filled + blank + piece.width > width) {
      lines.push_back(piece.text);
      filled = piece.width;
      continue;
    }
    if (piece.blank_before) lines.back() += ' ';
    lines.back() += piece.text;
    filled += blank + piece.width;
  }
  return lines;
}

}  // namespace nade::study
