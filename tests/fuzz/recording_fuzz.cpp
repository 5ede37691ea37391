// A recording in any of the formats, plain or gzip: told from its bytes.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "input_file.h"
#include "nade/io/object_file.h"
#include "nade/io/recording.h"

namespace {

/// Puts a hand beside the inputs, which angles of HOT3D bend: each digit along +X.
bool write_hot3d_hand() {
  std::ostringstream hinges;
  std::ostringstream axes;
  std::ostringstream tips;
  for (int digit = 0; digit < 5; ++digit) {
    const char* const comma = digit == 0 ? "" : ",";
    const int aside = 30 - 20 * digit;
    const int share = digit == 0 ? 2 : 1;  // the thumb is half as long
    hinges << comma << '[' << 90 / share << ",0," << aside << "]";
    for (const int along : {90, 130, 155}) {
      hinges << ",[" << along / share << ",0," << aside << ']';
    }
    axes << comma << "[0,0,-1],[0,0,-1],[0,0,-1],[0,0,-1]";
    tips << comma << '[' << 180 / share << ",0," << aside << ']';
  }
  std::ofstream(std::filesystem::temp_directory_path() / "umetrack_hand_user_profile.json")
      << R"({"hand_model":{"joint_rest_positions":[)" << hinges.str()
      << R"(],"joint_rotation_axes":[)" << axes.str() << R"(],"landmark_rest_positions":[)"
      << tips.str() << "]}}";
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nade;
  static const bool kWritten = write_hot3d_hand();
  (void)kWritten;
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
