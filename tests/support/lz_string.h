#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

namespace nade::test {

/// Packs as LZString's `compressToBase64` does.
class LzString {
 public:
  /// `spaces` as many words of spaces, each one space longer than the last, follow the text.
  [[nodiscard]] static std::string packed(std::u16string_view text, std::size_t spaces = 0) {
    LzString lz;
    std::u16string word;
    for (const char16_t unit : text) {
      const std::u16string character(1, unit);
      if (lz.codes_.try_emplace(character, lz.codes_.size() + kFirstCode).second) {
        lz.new_.insert(character);
      }
      if (lz.codes_.contains(word + unit)) {
        word += unit;
        continue;
      }
      lz.put_word(word);
      lz.codes_.emplace(word + unit, lz.codes_.size() + kFirstCode);
      word = character;
    }
    if (!word.empty()) lz.put_word(word);
    lz.put_spaces(spaces);
    lz.put(kEndCode, lz.width_);
    do {
      lz.put(0, 1);
    } while (lz.bit_count_ != 0);
    while (lz.out_.size() % 4 != 0) lz.out_ += '=';
    return lz.out_;
  }
  [[nodiscard]] static std::string packed(std::string_view ascii, std::size_t spaces = 0) {
    return packed(std::u16string(ascii.begin(), ascii.end()), spaces);
  }

 private:
  static constexpr std::size_t kFirstCode = 3;
  static constexpr std::size_t kEndCode = 2;

  void put(std::size_t value, unsigned count) {
    constexpr std::string_view kAlphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (; count > 0; --count, value >>= 1U) {
      bits_ = bits_ << 1U | (value & 1U);
      if (++bit_count_ < 6) continue;
      out_ += kAlphabet[bits_];
      bits_ = bit_count_ = 0;
    }
  }
  void put_word(const std::u16string& word) {
    if (new_.erase(word) > 0) {
      const unsigned wide = word[0] < 256 ? 0 : 1;
      put(wide, width_);
      put(word[0], wide == 0 ? 8 : 16);
      count_word();
    } else {
      put(codes_.at(word), width_);
    }
    count_word();
  }
  /// Each word but the first is the one that is only being made. The text has no space.
  void put_spaces(std::size_t words) {
    if (words == 0) return;
    const std::size_t first = codes_.size() + kFirstCode;
    new_.insert(u" ");
    put_word(u" ");
    for (std::size_t i = 1; i < words; ++i) {
      put(first + 1 + i, width_);
      count_word();
    }
  }
  void count_word() {
    if (--until_wider_ > 0) return;
    until_wider_ = std::size_t{1} << width_++;
  }

  std::map<std::u16string, std::size_t> codes_;
  std::set<std::u16string> new_;
  std::size_t until_wider_ = 2;
  unsigned width_ = 2;
  std::size_t bits_ = 0;
  unsigned bit_count_ = 0;
  std::string out_;
};

}  // namespace nade::test
