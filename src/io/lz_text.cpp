#include "lz_text.h"

#include "nade/io/plain_text.h"
#include "sketch_reader.h"

namespace nade::io {
namespace {

constexpr unsigned kBase64Bits = 6;
constexpr std::uint32_t kEndCode = 2;

std::optional<std::uint32_t> base64_value(char c) {
  constexpr std::string_view kAlphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t found = kAlphabet.find(c);
  if (found == std::string_view::npos) return std::nullopt;
  return static_cast<std::uint32_t>(found);
}

/// The first bit is the highest there, and the lowest in what it is read into.
std::uint32_t reversed(std::uint32_t value) {
  std::uint32_t result = 0;
  for (unsigned i = 0; i < kBase64Bits; ++i) result |= (value >> i & 1U) << (kBase64Bits - 1 - i);
  return result;
}

void append_utf8(std::uint32_t code_point, std::string& text) {
  const auto byte = [&](std::uint32_t value) { text += static_cast<char>(value); };
  const auto rest = [&](unsigned shift) { byte(0x80U | (code_point >> shift & 0x3FU)); };
  if (code_point < 0x80U) {
    byte(code_point);
  } else if (code_point < 0x800U) {
    byte(0xC0U | code_point >> 6U);
    rest(0);
  } else if (code_point < 0x10000U) {
    byte(0xE0U | code_point >> 12U);
    rest(6);
    rest(0);
  } else {
    byte(0xF0U | code_point >> 18U);
    rest(12);
    rest(6);
    rest(0);
  }
}

}  // namespace

LzText::End LzText::read(std::string_view& packed, std::string& text, std::size_t enough) {
  while (text.size() < enough) {
    const unsigned needed = character_width_ > 0 ? character_width_ : code_width_;
    if (!whole_ && bit_count_ >= needed) {
      const std::uint32_t value = bits_ & ((1U << needed) - 1U);
      bits_ >>= needed;
      bit_count_ -= needed;
      if (character_width_ > 0) {
        take_character(static_cast<std::uint16_t>(value), text);
      } else if (!take_code(value, text)) {
        return End::damaged;
      }
      if (words_.size() > kMostWords) return End::too_many_words;
      continue;
    }
    if (packed.empty()) return whole_ ? End::whole : End::more;
    const char next = packed.front();
    packed.remove_prefix(1);
    // LZString may put bits of no meaning behind the end.
    if (is_space(next) || (whole_ && (next == '=' || next == 'A'))) continue;
    const std::optional<std::uint32_t> value = base64_value(next);
    if (!value || whole_) return End::damaged;
    bits_ |= reversed(*value) << bit_count_;
    bit_count_ += kBase64Bits;
  }
  return End::more;
}

bool LzText::take_code(std::uint32_t code, std::string& text) {
  if (code == kEndCode) {
    whole_ = true;
    return true;
  }
  if (code > kEndCode) return take_word(code, text);
  character_width_ = code == 0 ? 8 : 16;
  return true;
}

void LzText::take_character(std::uint16_t unit, std::string& text) {
  character_width_ = 0;
  add_word(kNoWord, unit);
  const auto word = static_cast<std::uint32_t>(words_.size() - 1);
  // The first character of all makes no word with what stands before it.
  if (previous_ == kNoWord) {
    words_until_wider_ = 4;
    code_width_ = 3;
  } else {
    add_word(previous_, unit);
  }
  append_word(word, text);
  previous_ = word;
}

bool LzText::take_word(std::uint32_t word, std::string& text) {
  // The word that is only being made can be asked for already.
  if (previous_ == kNoWord || word > words_.size()) return false;
  add_word(previous_, words_[word < words_.size() ? word : previous_].first);
  append_word(word, text);
  previous_ = word;
  return true;
}

void LzText::add_word(std::uint32_t before, std::uint16_t last) {
  Word word{before, words_[before].length + 1, last, last};
  if (before != kNoWord) word.first = words_[before].first;
  words_.push_back(word);
  if (--words_until_wider_ > 0) return;
  words_until_wider_ = std::size_t{1} << code_width_;
  ++code_width_;
}

void LzText::append_word(std::uint32_t word, std::string& text) {
  units_.resize(words_[word].length);
  for (std::size_t i = units_.size(); i > 0; --i) {
    units_[i - 1] = words_[word].last;
    word = words_[word].before;
  }
  for (const std::uint16_t unit : units_) append_unit(unit, text);
}

void LzText::append_unit(std::uint16_t unit, std::string& text) {
  const bool low = (unit & 0xFC00U) == 0xDC00U;
  if (high_surrogate_ != 0) {
    const std::uint32_t pair = 0x10000U + ((high_surrogate_ & 0x3FFU) << 10U) + (unit & 0x3FFU);
    high_surrogate_ = 0;
    append_utf8(low ? pair : kReplacement, text);
    if (low) return;
  }
  if ((unit & 0xFC00U) == 0xD800U) {
    high_surrogate_ = unit;
    return;
  }
  append_utf8(low ? kReplacement : unit, text);
}

bool looks_like_lz_text(std::string_view beginning) {
  LzText lz;
  std::string text;
  const LzText::End end = lz.read(beginning, text, 1);
  if (end == LzText::End::damaged) return false;
  return text.starts_with('{') || text.starts_with('[');
}

}  // namespace nade::io
