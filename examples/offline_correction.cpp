// Reads a recording, corrects both hands against an object, writes the corrected recording:
//   offline_correction IN OUT OBJECT

#include <array>
#include <cstdio>
#include <string>

#include "nade/corrector.h"
#include "nade/io/object_file.h"
#include "nade/io/recording.h"

namespace {

void correct_frame(nade::RecordedFrame& frame, const nade::Object& object,
                   std::array<nade::HandCorrector, 2>& correctors) {
  for (std::size_t side = 0; side < frame.hands.size(); ++side) {
    if (!frame.hands[side]) continue;
    nade::RecordedHand& hand = *frame.hands[side];
    const nade::CorrectedHand& corrected =
        correctors[side].update(hand.pose, object, frame.time_ns);
    hand.pose = corrected.pose;
    hand.status = corrected.status;
  }
}

nade::Status correct(const std::string& in, const std::string& out, const std::string& spec) {
  const auto loaded = nade::load_object(spec);
  if (!loaded) return loaded.error();
  const nade::Object object = loaded->placed();

  auto reader = nade::RecordingReader::open(in);
  if (!reader) return reader.error();
  auto writer = nade::RecordingWriter::create(out, reader->header());
  if (!writer) return writer.error();

  std::array<nade::HandCorrector, 2> correctors;
  while (true) {
    auto frame = reader->next();
    if (!frame) return frame.error();
    if (!frame->has_value()) return writer->finish();
    correct_frame(**frame, object, correctors);
    if (nade::Status written = writer->write(**frame); !written) return written;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: offline_correction IN OUT OBJECT\n");
    return 2;
  }
  const nade::Status status = correct(argv[1], argv[2], argv[3]);
  if (status) return 0;
  std::fprintf(stderr, "offline_correction: %s\n", status.error().message.c_str());
  return 1;
}
