#include <memory>
#include <string>

#include "commands.h"
#include "inspection.h"
#include "nade/io/output_file.h"
#include "nade/io/recording.h"

namespace nade::cli {
namespace {

enum class Report { text, json };

struct InspectArguments {
  std::string input;
  Report report = Report::text;
};

Status run_inspect(const InspectArguments& arguments) {
  Result<RecordingReader> reader = RecordingReader::open(arguments.input);
  if (!reader) return reader.error();
  Inspection inspection;
  while (true) {
    const Result<std::optional<RecordedFrame>> frame = reader->next();
    if (!frame) return frame.error();
    if (!*frame) break;
    inspection.add(**frame);
  }
  const auto report = as_json(inspection, *reader);
  Result<OutputFile> out = OutputFile::create("-", OutputFile::Encoding::plain);
  if (!out) return out.error();
  const Status written =
      out->write(arguments.report == Report::json
                     ? report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"
                     : as_text(report));
  if (!written.ok()) return written;
  return out->finish();
}

}  // namespace

void add_inspect(CLI::App& app, Action& action) {
  CLI::App* const command = app.add_subcommand("inspect", "Says what is in a recording");
  const auto arguments = std::make_shared<InspectArguments>();
  command->add_option("input", arguments->input, "the recording to read; - is stdin")
      ->type_name("IN")
      ->required();
  command->add_flag_callback(
      "--json", [arguments] { arguments->report = Report::json; },
      "prints one JSON object and nothing else");
  command->callback(
      [&action, arguments] { action = [arguments] { return run_inspect(*arguments); }; });
}

}  // namespace nade::cli
