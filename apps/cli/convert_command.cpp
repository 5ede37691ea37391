#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <memory>
#include <string>

#include "command_files.h"
#include "commands.h"
#include "console.h"
#include "nade/io/recording.h"

namespace nade::cli {
namespace {

struct ConvertArguments {
  std::string input;
  std::string output;
};

std::string now_utc() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

/// Ours keeps the time it was made; another format gets that of its conversion.
RecordingHeader converted_header(const RecordingReader& reader) {
  RecordingHeader header = reader.header();
  if (header.created.empty() && reader.format() != RecordingFormat::nade) {
    header.created = now_utc();
  }
  return header;
}

Status run_convert(const ConvertArguments& arguments) {
  const Status name = check_recording_name("--output", arguments.output);
  if (!name) return name;
  Result<RecordingReader> reader = RecordingReader::open(arguments.input);
  if (!reader) return reader.error();
  Result<RecordingWriter> writer =
      RecordingWriter::create(arguments.output, converted_header(*reader));
  if (!writer) return writer.error();
  std::size_t frames = 0;
  while (true) {
    const Result<std::optional<RecordedFrame>> frame = reader->next();
    if (!frame) return frame.error();
    if (!*frame) break;
    const Status written = writer->write(**frame);
    if (!written.ok()) return written;
    ++frames;
  }
  const Status finished = writer->finish();
  if (!finished.ok()) return finished;
  for (const std::string& warning : reader->warnings()) warn(warning);
  say(fmt::format("{}: {} frames from {}", arguments.output, frames, arguments.input));
  return ok_status();
}

}  // namespace

void add_convert(CLI::App& app, Action& action) {
  CLI::App* const command = app.add_subcommand(
      "convert", "Turns a recording of any known format into ours, or into a table (.csv)");
  const auto arguments = std::make_shared<ConvertArguments>();
  command->add_option("input", arguments->input, "the recording to read; - is stdin")
      ->type_name("IN")
      ->required();
  command->add_option("-o,--output", arguments->output, "the recording to write; - is stdout")
      ->type_name("OUT")
      ->required();
  command->callback(
      [&action, arguments] { action = [arguments] { return run_convert(*arguments); }; });
}

}  // namespace nade::cli
