#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "batch.h"
#include "command_files.h"
#include "commands.h"
#include "console.h"
#include "frame_pipe.h"
#include "model_options.h"
#include "nade/io/object_file.h"
#include "nade/io/recording.h"

namespace nade::cli {
namespace {

struct ConvertArguments {
  BatchOptions files;
  ModelChoice model;
  std::string recipe;
};

/// The object that the recording's header names is the one to be shown.
Result<ModelOptions> model_of(const ModelChoice& choice, const RecordingReader& reader,
                              const std::string& input) {
  ModelOptions model{!choice.flat, nullptr};
  if (!choice.with_object) return model;
  auto placing = placing_from(reader.header().unknown_json, input);
  if (!placing) return placing.error();
  if (!*placing) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: --with-object: expected an object in the recording's header, as "
                             "nade correct writes it, found none",
                             input)};
  }
  const Result<PlacedObject> placed = load_placed({}, *placing);
  if (!placed) return placed.error();
  model.object = shown_object(*placed);
  return model;
}

/// What was converted: for sums over many.
Result<nlohmann::ordered_json> convert(const BatchItem& item, const ModelChoice& choice) {
  Result<RecordingReader> reader = RecordingReader::open(item.input);
  if (!reader) return reader.error();
  const Result<ModelOptions> model = model_of(choice, *reader, item.input);
  if (!model) return model.error();
  Result<RecordingWriter> writer =
      RecordingWriter::create(item.output, reader->header(), {}, *model);
  if (!writer) return writer.error();
  std::optional<std::int64_t> first_ns;
  double seconds = 0.0;
  const Result<std::size_t> frames = pipe_frames(
      *reader, std::nullopt,
      [&](const RecordedFrame& frame) {
        if (!first_ns) first_ns = frame.time_ns;
        seconds = 1e-9 * static_cast<double>(frame.time_ns - *first_ns);
      },
      *writer);
  if (!frames) return frames.error();
  const Status finished = writer->finish();
  if (!finished) return finished.error();
  for (const std::string& warning : reader->warnings()) warn(warning);
  return nlohmann::ordered_json{{"frames", *frames}, {"seconds", seconds}};
}

Status run_convert(const ConvertArguments& arguments) {
  if (arguments.files.many()) {
    return run_batch(arguments.files, arguments.recipe, "converted",
                     [&arguments](const BatchItem& item, std::size_t) {
                       return convert(item, arguments.model);
                     });
  }
  const BatchItem item{arguments.files.inputs.front(), arguments.files.output};
  const Status name = check_recording_name("--output", item.output);
  if (!name) return name;
  const Result<nlohmann::ordered_json> figures = convert(item, arguments.model);
  if (!figures) return figures.error();
  say(fmt::format("{}: {} frames from {}", item.output, figures->at("frames").get<std::size_t>(),
                  item.input));
  return ok_status();
}

}  // namespace

void add_convert(CLI::App& app, Action& action) {
  CLI::App* const command = app.add_subcommand("convert",
                                               "Turns a recording of any known format into ours, a "
                                               "table (.csv), messages for Foxglove (.mcap) "
                                               "or a model (.glb)");
  const auto arguments = std::make_shared<ConvertArguments>();
  add_batch_options(*command, arguments->files);
  add_model_choice(*command, arguments->model);
  command->callback([&action, arguments, command] {
    arguments->recipe = recipe_of(*command);
    action = [arguments] { return run_convert(*arguments); };
  });
}

}  // namespace nade::cli
