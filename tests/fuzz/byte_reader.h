#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace nade::fuzz {

/// Takes values off an input, zeros once it is used up.
class ByteReader {
 public:
  ByteReader(const std::uint8_t* data, std::size_t size) : at_(data), left_(size) {}

  [[nodiscard]] bool empty() const { return left_ == 0; }

  /// Any bit pattern.
  template <class T>
  [[nodiscard]] T take() {
    std::array<std::uint8_t, sizeof(T)> bytes{};
    for (std::uint8_t& byte : bytes) {
      if (left_ == 0) break;
      byte = *at_++;
      --left_;
    }
    T value;
    std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
  }

  /// -`most` to `most`, of one byte.
  [[nodiscard]] double within(double most) { return most * take<std::int8_t>() / 127.0; }

 private:
  const std::uint8_t* at_;
  std::size_t left_;
};

}  // namespace nade::fuzz
