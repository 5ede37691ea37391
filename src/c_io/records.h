#pragma once

#include <optional>
#include <string>
#include <vector>

#include "arguments.h"
#include "nade/io/recording.h"
#include "nade_io.h"

namespace nade::c_abi {

struct HeldReader {
  RecordingReader reader;
  std::optional<Error> failure;       ///< of `next`
  std::vector<std::string> warnings;  ///< as they were asked for
};

struct HeldWriter {
  RecordingWriter writer;
  bool finished = false;
};

}  // namespace nade::c_abi

struct nade_io_reader : nade::c_abi::HandlePlace<nade::c_abi::HeldReader> {};
struct nade_io_writer : nade::c_abi::HandlePlace<nade::c_abi::HeldWriter> {};

namespace nade::c_abi {

template <>
struct HandleKind<nade_io_reader> {
  static constexpr std::uint32_t kMark = 0x6e616411;
  static constexpr const char* kName = "reader";
};
template <>
struct HandleKind<nade_io_writer> {
  static constexpr std::uint32_t kMark = 0x6e616412;
  static constexpr const char* kName = "writer";
};

// As long as nothing was added to them.
template <>
struct FieldEnds<nade_io_info> {
  static constexpr const char* kName = "nade_io_info";
  static constexpr std::array<std::size_t, 0> kEnds{};
};
template <>
struct FieldEnds<nade_io_frame> {
  static constexpr const char* kName = "nade_io_frame";
  static constexpr std::array<std::size_t, 0> kEnds{};
};

/// An error of a file, as this interface has it.
[[nodiscard]] nade_status fail(const Error& error) noexcept;

/// NADE_OK, or what is wrong with a file's name.
[[nodiscard]] nade_status check_path(const char* path) noexcept;

[[nodiscard]] nade_io_frame frame_from(const RecordedFrame& frame) noexcept;
/// NADE_OK, with the frame in `recorded`, or what is wrong with it.
[[nodiscard]] nade_status read_frame(const nade_io_frame& frame, RecordedFrame& recorded);

}  // namespace nade::c_abi
