#include "press_option.h"

#include <fmt/format.h>

#include "console.h"
#include "nade/io/recording.h"
#include "number_options.h"

namespace nade::cli {
namespace {

Result<PalmTrack> read_palms(const std::string& path) {
  Result<RecordingReader> reader = RecordingReader::open(path);
  if (!reader) return reader.error();
  PalmTrack track;
  while (true) {
    const Result<std::optional<RecordedFrame>> frame = reader->next();
    if (!frame) return frame.error();
    if (!*frame) break;
    track.add(**frame);
  }
  // Why there are no hands: what is done next cannot say it.
  if (track.frames().empty()) {
    for (const std::string& warning : reader->warnings()) warn(warning);
  }
  return track;
}

}  // namespace

CLI::Option* add_press_option(CLI::App& command, std::optional<double>& press_m) {
  return command
      .add_option("--press", press_m,
                  "moves the object so that the palms' skin lies so deep at the median")
      ->type_name("M")
      ->check(number_in(0.0, 0.2));
}

Status press_onto(const PalmTrack& palms, const std::string& path, double press_m,
                  PlacedObject& placed) {
  const Result<Placement> pressed = press(placed.loaded, placed.placement, palms, press_m);
  if (!pressed) {
    if (pressed.error().code == ErrorCode::out_of_range) return pressed.error();
    return Error{pressed.error().code, fmt::format("{}: {}", path, pressed.error().message)};
  }
  placed.placement = *pressed;
  return ok_status();
}

Status press_onto(const std::string& path, double press_m, PlacedObject& placed) {
  const Result<PalmTrack> palms = read_palms(path);
  if (!palms) return palms.error();
  return press_onto(*palms, path, press_m, placed);
}

}  // namespace nade::cli
