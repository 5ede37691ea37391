// A recording in any of the formats, plain or gzip: told from its bytes.
#include <cstddef>
#include <cstdint>

#include "input_file.h"
#include "nade/io/object_file.h"
#include "nade/io/recording.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nade;
  const fuzz::InputFile file(fuzz::text_of(data, size), ".jsonl");
  Result<RecordingReader> reader = RecordingReader::open(file.path());
  if (!reader) return 0;
  const std::string& header = reader->header().unknown_json;
  (void)placing_from(header, "input");
  (void)softness_from(header);
  std::int64_t before_ns = 0;
  for (bool first = true;; first = false) {
    const Result<std::optional<RecordedFrame>> frame = reader->next();
    if (!frame || !frame->has_value()) break;
    fuzz::demand(first || (*frame)->time_ns > before_ns);
    before_ns = (*frame)->time_ns;
    for (const auto& hand : (*frame)->hands) fuzz::demand(!hand || is_usable(hand->pose));
  }
  (void)reader->warnings();
  return 0;
}
