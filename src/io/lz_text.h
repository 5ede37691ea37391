#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nade::io {

/// Unpacks what LZString's `compressToBase64` has packed, in pieces, as UTF-8.
/// Source: Ziv, Lempel. Compression of Individual Sequences via Variable-Rate Coding. 1978.
/// Source: Pieroxy. lz-string 1.4, whose codes these are: 0 and 1 before a new character of 8 or 16
/// bits, 2 at the end, further ones for words.
class LzText {
 public:
  enum class End { more, whole, damaged, too_many_words };

  /// Each takes 12 bytes of memory. A recording of an hour has a million.
  static constexpr std::size_t kMostWords = std::size_t{1} << 22;

  /// Unpacks from `packed` on, whose beginning it takes away, until `text` has `enough` bytes.
  [[nodiscard]] End read(std::string_view& packed, std::string& text, std::size_t enough);

  [[nodiscard]] bool whole() const { return whole_; }

 private:
  /// Another word with a character behind it.
  struct Word {
    std::uint32_t before = 0;
    std::uint32_t length = 0;
    std::uint16_t first = 0;
    std::uint16_t last = 0;
  };
  static constexpr std::uint32_t kFirstWord = 3;
  static constexpr std::uint32_t kNoWord = 0;

  [[nodiscard]] bool take_code(std::uint32_t code, std::string& text);
  [[nodiscard]] bool take_word(std::uint32_t word, std::string& text);
  void take_character(std::uint16_t unit, std::string& text);
  void add_word(std::uint32_t before, std::uint16_t last);
  void append_word(std::uint32_t word, std::string& text);
  void append_unit(std::uint16_t unit, std::string& text);

  std::vector<Word> words_ = std::vector<Word>(kFirstWord);  ///< by code
  std::vector<std::uint16_t> units_;                         ///< of one word
  std::uint32_t previous_ = kNoWord;
  std::uint32_t bits_ = 0;  ///< not yet taken, the first one lowest
  unsigned bit_count_ = 0;
  unsigned code_width_ = 2;
  std::size_t words_until_wider_ = 2;
  unsigned character_width_ = 0;  ///< of the character that comes next; 0 where a code does
  std::uint16_t high_surrogate_ = 0;
  bool whole_ = false;
};

/// Whether a file that begins so is JSON that LZString has packed, as LeapJS Playback keeps its
/// recordings.
[[nodiscard]] bool looks_like_lz_text(std::string_view beginning);

}  // namespace nade::io
