#include "show.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "commands.h"
#include "console.h"
#include "press_option.h"
#include "tracked_check.h"

namespace nade::cli {
namespace {

/// What the headers of the recordings say.
struct Headers {
  std::optional<ObjectPlacing> placing;
  double softness_m = 0.0;
  Method method = Method::none;  ///< of the corrected one
  bool is_corrected = false;     ///< the first recording names a method
  bool second_is_corrected = false;
};

Result<RecordingHeader> header_of(const std::string& path) {
  Result<RecordingReader> reader = RecordingReader::open(path);
  if (!reader) return reader.error();
  return reader->header();
}

/// The corrected recording's word counts more: it says where the object stood.
Result<Headers> read_headers(const ShowArguments& arguments) {
  Headers headers;
  for (const std::optional<std::string>& path :
       {arguments.corrected, std::optional(arguments.recording)}) {
    if (!path) continue;
    const Result<RecordingHeader> header = header_of(*path);
    if (!header) return header.error();
    const auto placing = placing_from(header->unknown_json, *path);
    if (!placing) return placing.error();
    if (!headers.placing) headers.placing = *placing;
    const double softness_m = softness_from(header->unknown_json);
    if (softness_m > 0.0) headers.softness_m = softness_m;
    const std::optional<Method> method = method_from_name(method_of(*header));
    if (method && *method != Method::none) headers.method = *method;
    headers.second_is_corrected = headers.is_corrected;  // which is read first
    headers.is_corrected = is_corrected(*header);
  }
  return headers;
}

Status check(const ShowArguments& arguments, const Headers& headers) {
  if (arguments.corrected && arguments.press_m) {
    return misuse("--press cannot be used with CORRECTED, whose object stood where it stood");
  }
  const std::optional<std::string> method = given_of(arguments.method);
  if (method && (arguments.corrected || headers.is_corrected)) {
    return misuse(fmt::format(
        "{} cannot be used with a corrected recording, whose hands are as they were corrected",
        *method));
  }
  if (arguments.corrected && headers.is_corrected) {
    return not_tracked(arguments.recording, kTrackedFirst);
  }
  if (arguments.corrected && !headers.second_is_corrected) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: expected a corrected recording second, found a tracked one",
                             *arguments.corrected)};
  }
  if (!arguments.object.object && !headers.placing) {
    return Error{
        ErrorCode::out_of_range,
        fmt::format("--object is needed: {} names none in its header", arguments.recording)};
  }
  return ok_status();
}

}  // namespace

void add_show_options(CLI::App& command, ShowArguments& arguments) {
  add_object_options(command, arguments.object);
  add_press_option(command, arguments.press_m);
  add_hand_options(command, arguments.hands);
}

Status check_apart(const std::string& output, const ShowArguments& arguments) {
  std::vector<NamedFile> inputs = hand_files(arguments.hands);
  inputs.insert(inputs.end(), {{"IN", arguments.recording},
                               {"CORRECTED", arguments.corrected},
                               object_file(arguments.object)});
  return check_apart({{"--output", output}}, inputs);
}

Result<Show> prepare(const ShowArguments& arguments) {
  const Result<Headers> headers = read_headers(arguments);
  if (!headers) return headers.error();
  const Status fits = check(arguments, *headers);
  if (!fits) return fits.error();
  Result<draw::HandMeshes> hands = load_hands(arguments.hands);
  if (!hands) return hands.error();
  Result<Survey> seen = survey(arguments.recording, *hands);
  if (!seen) return seen.error();
  if (seen->glimpses.empty()) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: expected a tracked hand, found none in {} frames",
                             arguments.recording, seen->frames)};
  }
  Result<PlacedObject> placed = load_placed(arguments.object, headers->placing);
  if (!placed) return placed.error();
  if (arguments.press_m) {
    const Status pressed =
        press_onto(seen->palms, arguments.recording, *arguments.press_m, *placed);
    if (!pressed) return pressed.error();
  }
  placed->start_animation(seen->first_ns);
  Performance performance{arguments.recording, arguments.corrected, options_of(arguments.method),
                          seen->scale, headers->method};
  use_own_hands(arguments.hands, *hands, performance.method);
  if (headers->is_corrected) performance.method.method = Method::none;
  if (!headers->is_corrected && !arguments.corrected) {
    performance.drawn = performance.method.method;
  }
  const double softness_m = std::max(performance.method.settle.softness_m, headers->softness_m);
  return Show{std::move(hands).value(),
              std::move(seen).value(),
              std::move(placed).value(),
              std::move(performance),
              softness_m,
              !headers->is_corrected};
}

Result<Studio> open_studio(const draw::HandMeshes& hands) {
  Result<draw::OffscreenContext> context = draw::OffscreenContext::create();
  if (!context) return context.error();
  Result<draw::Renderer> made = draw::Renderer::create();
  if (!made) return made.error();
  auto renderer = std::make_unique<draw::Renderer>(std::move(made).value());
  Result<draw::Stage> stage = draw::Stage::create(*renderer, hands);
  if (!stage) return stage.error();
  return Studio{std::move(context).value(), std::move(renderer), std::move(stage).value()};
}

Status set_object(Studio& studio, const PlacedObject& placed) {
  const Status status = studio.stage.set_object(placed.loaded, placed.placement);
  for (const std::string& warning : studio.stage.warnings()) warn(warning);
  return status;
}

}  // namespace nade::cli
