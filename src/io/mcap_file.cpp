#include "mcap_file.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace nade::io {
namespace {

constexpr std::string_view kMcapMagic("\x89MCAP0\r\n", 8);
constexpr std::size_t kChunkBytes = std::size_t{1} << 20;

enum class Op : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

/// Appends numbers, the lowest byte first.
template <class Unsigned>
void put(std::string& out, Unsigned value) {
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    out += static_cast<char>(static_cast<unsigned char>(std::uint64_t{value} >> (8 * i)));
  }
}

void put_text(std::string& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out += text;
}

void put_map(std::string& out, const McapFile::Map& map) {
  std::string content;
  for (const auto& [key, value] : map) {
    put_text(content, key);
    put_text(content, value);
  }
  put_text(out, content);
}

std::string record(Op op, std::string_view content) {
  std::string bytes;
  put(bytes, static_cast<std::uint8_t>(op));
  put(bytes, std::uint64_t{content.size()});
  bytes += content;
  return bytes;
}

unsigned long crc_of(unsigned long before, std::string_view bytes) {
  return ::crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
}

}  // namespace

McapFile::McapFile(std::string_view library) {
  append(kMcapMagic);
  std::string content;
  put_text(content, "");  // no profile of anyone else's
  put_text(content, library);
  append(record(Op::header, content));
}

void McapFile::append(std::string_view bytes) {
  pending_ += bytes;
  position_ += bytes.size();
  crc_ = crc_of(crc_, bytes);
}

std::uint16_t McapFile::add_schema(std::string_view name, std::string_view json_schema) {
  std::string content;
  put(content, ++schema_count_);
  put_text(content, name);
  put_text(content, "jsonschema");
  put_text(content, json_schema);
  const std::string bytes = record(Op::schema, content);
  schemas_ += bytes;
  append(bytes);
  return schema_count_;
}

std::uint16_t McapFile::add_channel(std::uint16_t schema, std::string_view topic,
                                    const Map& metadata) {
  message_counts_.push_back(0);
  const auto id = static_cast<std::uint16_t>(message_counts_.size());
  std::string content;
  put(content, id);
  put(content, schema);
  put_text(content, topic);
  put_text(content, "json");
  put_map(content, metadata);
  const std::string bytes = record(Op::channel, content);
  channels_ += bytes;
  append(bytes);
  return id;
}

void McapFile::add_metadata(std::string_view name, const Map& metadata) {
  std::string content;
  put_text(content, name);
  put_map(content, metadata);
  const std::string bytes = record(Op::metadata, content);
  std::string index;
  put(index, position_);
  put(index, std::uint64_t{bytes.size()});
  put_text(index, name);
  metadata_indexes_ += record(Op::metadata_index, index);
  ++metadata_count_;
  append(bytes);
}

void McapFile::add_message(std::uint16_t channel, std::uint64_t time_ns, std::string_view json) {
  std::uint64_t& count = message_counts_[channel - std::size_t{1}];
  if (chunk_.records.empty()) chunk_.first_ns = time_ns;
  if (chunk_.records.empty() && chunk_count_ == 0) first_ns_ = time_ns;
  chunk_.last_ns = last_ns_ = time_ns;
  std::string& index = chunk_.indexes[channel];
  put(index, time_ns);
  put(index, std::uint64_t{chunk_.records.size()});
  std::string content;
  put(content, channel);
  put(content, static_cast<std::uint32_t>(count++));
  put(content, time_ns);  // logged
  put(content, time_ns);  // published
  content += json;
  chunk_.records += record(Op::message, content);
  if (chunk_.records.size() >= kChunkBytes) flush_chunk();
}

void McapFile::flush_chunk() {
  if (chunk_.records.empty()) return;
  const std::uint64_t size = chunk_.records.size();
  const std::uint64_t start = position_;
  std::string content;
  put(content, chunk_.first_ns);
  put(content, chunk_.last_ns);
  put(content, size);
  put(content, static_cast<std::uint32_t>(crc_of(0, chunk_.records)));
  put_text(content, "");  // not compressed
  put(content, size);
  content += chunk_.records;
  append(record(Op::chunk, content));
  const std::uint64_t length = position_ - start;
  std::string offsets;
  for (const auto& [channel, entries] : chunk_.indexes) {
    put(offsets, channel);
    put(offsets, position_);
    std::string index;
    put(index, channel);
    put_text(index, entries);
    append(record(Op::message_index, index));
  }
  std::string index;
  for (const std::uint64_t number : {chunk_.first_ns, chunk_.last_ns, start, length}) {
    put(index, number);
  }
  put_text(index, offsets);
  put(index, position_ - start - length);
  put_text(index, "");
  put(index, size);
  put(index, size);
  chunk_indexes_ += record(Op::chunk_index, index);
  ++chunk_count_;
  chunk_ = {};
}

std::string McapFile::statistics() const {
  std::string content;
  put(content, std::accumulate(message_counts_.begin(), message_counts_.end(), std::uint64_t{0}));
  put(content, schema_count_);
  put(content, static_cast<std::uint32_t>(message_counts_.size()));
  put(content, std::uint32_t{0});  // attachments
  put(content, metadata_count_);
  put(content, chunk_count_);
  put(content, first_ns_);
  put(content, last_ns_);
  std::string counts;
  for (std::size_t i = 0; i < message_counts_.size(); ++i) {
    put(counts, static_cast<std::uint16_t>(i + 1));
    put(counts, message_counts_[i]);
  }
  put_text(content, counts);
  return record(Op::statistics, content);
}

void McapFile::append_summary() {
  const std::uint64_t start = position_;
  crc_ = 0;
  const std::string statistics_record = statistics();
  const std::array<std::pair<Op, const std::string*>, 5> groups{
      {{Op::schema, &schemas_},
       {Op::channel, &channels_},
       {Op::statistics, &statistics_record},
       {Op::chunk_index, &chunk_indexes_},
       {Op::metadata_index, &metadata_indexes_}}};
  std::string offsets;
  for (const auto& [op, records] : groups) {
    if (records->empty()) continue;
    std::string content;
    put(content, static_cast<std::uint8_t>(op));
    put(content, position_);
    put(content, std::uint64_t{records->size()});
    offsets += record(Op::summary_offset, content);
    append(*records);
  }
  const std::uint64_t offsets_start = position_;
  append(offsets);
  std::string content;
  put(content, start);
  put(content, offsets_start);
  put(content, std::uint32_t{0});
  // Its checksum is over all of the footer that stands before it.
  std::string footer = record(Op::footer, content);
  footer.resize(footer.size() - sizeof(std::uint32_t));
  append(footer);
  std::string checksum;
  put(checksum, static_cast<std::uint32_t>(crc_));
  append(checksum);
}

void McapFile::finish() {
  flush_chunk();
  std::string content;
  put(content, static_cast<std::uint32_t>(crc_));
  append(record(Op::data_end, content));
  append_summary();
  append(kMcapMagic);
}

}  // namespace nade::io
