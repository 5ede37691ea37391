#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nade::io {

/// The bytes of an MCAP file with JSON messages, in chunks that are not compressed, with indexes,
/// checksums and a summary. Memory grows by the index alone, 200 bytes a chunk.
/// Source: Foxglove. MCAP format specification. mcap.dev/spec, version 0.
class McapFile {
 public:
  using Map = std::map<std::string, std::string>;

  explicit McapFile(std::string_view library);

  /// Schemas and channels come before the first message.
  [[nodiscard]] std::uint16_t add_schema(std::string_view name, std::string_view json_schema);
  [[nodiscard]] std::uint16_t add_channel(std::uint16_t schema, std::string_view topic,
                                          const Map& metadata);
  void add_metadata(std::string_view name, const Map& metadata);
  void add_message(std::uint16_t channel, std::uint64_t time_ns, std::string_view json);
  void finish();

  /// What is to be written next.
  [[nodiscard]] std::string take() { return std::exchange(pending_, {}); }

 private:
  struct Chunk {
    std::string records;
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
    std::map<std::uint16_t, std::string> indexes;  ///< by channel: times and offsets
  };

  void append(std::string_view bytes);
  void flush_chunk();
  [[nodiscard]] std::string statistics() const;
  void append_summary();

  std::string pending_;
  std::uint64_t position_ = 0;  ///< of what follows `pending_`
  unsigned long crc_ = 0;       ///< of all before
  Chunk chunk_;
  std::string schemas_;  ///< records, for the summary
  std::string channels_;
  std::string metadata_indexes_;
  std::string chunk_indexes_;
  std::uint32_t metadata_count_ = 0;
  std::uint32_t chunk_count_ = 0;
  std::uint16_t schema_count_ = 0;
  std::vector<std::uint64_t> message_counts_;  ///< by channel, whose ids begin with 1
  std::uint64_t first_ns_ = 0;
  std::uint64_t last_ns_ = 0;
};

}  // namespace nade::io
