#include "gltf_resource.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <optional>
#include <system_error>

#include "nade/io/plain_text.h"
#include "whole_file.h"

// Based on: Berners-Lee et al. RFC 3986. 2005 (percent-encoding, schemes).
// Based on: Masinter. RFC 2397. 1998 (data URIs).

namespace nade::gltf {
namespace {

namespace fs = std::filesystem;

std::string without_percents(std::string_view text) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const int letter = std::tolower(static_cast<unsigned char>(c)) - 'a';
    return letter >= 0 && letter < 6 ? 10 + letter : -1;
  };
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool code = text[i] == '%' && i + 2 < text.size();
    const int high = code ? digit(text[i + 1]) : -1;
    const int low = code ? digit(text[i + 2]) : -1;
    if (high < 0 || low < 0) {
      result += text[i];
      continue;
    }
    result += static_cast<char>(16 * high + low);
    i += 2;
  }
  return result;
}

/// No value where a character is none of base 64's.
std::optional<std::string> from_base64(std::string_view text) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int count = 0;
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  for (const char c : text) {
    if (std::isspace(static_cast<unsigned char>(c)) != 0) continue;
    const std::size_t value = kDigits.find(c);
    if (value == std::string_view::npos) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFFU);
  }
  return bytes;
}

std::optional<std::string> decode_data(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const std::string data = without_percents(uri.substr(comma + 1));
  if (!uri.substr(0, comma).ends_with(";base64")) return data;
  return from_base64(data);
}

/// Whether a name starts with "http:" or another scheme, or a drive.
bool has_scheme(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon != std::string_view::npos && colon > 0 &&
         std::all_of(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(colon), [](char c) {
           return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' ||
                  c == '.';
         });
}

bool leads_out(const std::string& name) {
  std::string slashed = name;
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  const fs::path path(slashed);
  return path.is_absolute() || has_scheme(slashed) ||
         std::find(path.begin(), path.end(), "..") != path.end();
}

}  // namespace

Result<Resource> read_resource(const std::string& path, std::string_view where,
                               const std::string& uri) {
  const auto refuse = [&](ErrorCode code, std::string_view problem) {
    return Error{code, fmt::format("{}: {}: '{}': {}", path, where, shortened(uri), problem)};
  };
  if (uri.starts_with("data:")) {
    std::optional<std::string> bytes = decode_data(uri);
    if (!bytes) return refuse(ErrorCode::bad_format, "expected data in base 64");
    return Resource{std::move(*bytes), {}};
  }
  const std::string name = without_percents(uri);
  constexpr std::string_view kOutside = "expected a file below the glTF file's own folder";
  if (name.find('\0') != std::string::npos || leads_out(name)) {
    return refuse(ErrorCode::bad_value, kOutside);
  }
  const fs::path beside = fs::path(path).parent_path() / name;
  if (!io::is_below_folder_of(path, beside.string())) return refuse(ErrorCode::bad_value, kOutside);
  std::error_code failure;
  const fs::path file = fs::canonical(beside, failure);
  if (failure) return refuse(ErrorCode::not_found, "no such file");
  // A pipe or a device would never end.
  if (!fs::is_regular_file(file, failure)) return refuse(ErrorCode::unreadable, "cannot be read");
  Result<std::string> bytes = io::read_whole(file.string());
  if (!bytes) return refuse(ErrorCode::unreadable, "cannot be read");
  return Resource{std::move(*bytes), file};
}

std::string shortened(std::string_view text) {
  constexpr std::size_t kMost = 60;
  std::size_t length = std::min(text.size(), kMost);
  // Not within a letter of several bytes.
  while (length < text.size() && length > 0 && (text[length] & 0xC0) == 0x80) --length;
  const std::string line = plain_text(text.substr(0, length));
  return length < text.size() ? line + "…" : line;
}

}  // namespace nade::gltf
