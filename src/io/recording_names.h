#pragma once

#include <array>
#include <string_view>

namespace nade::io {

inline constexpr std::string_view kFormatName = "nade-recording";
inline constexpr int kFormatVersion = 1;

/// By index_of(HandStatus).
inline constexpr std::array<std::string_view, 4> kStatusNames{"free", "corrected", "released",
                                                              "untracked"};

}  // namespace nade::io
