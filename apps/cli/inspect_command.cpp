#include <memory>
#include <string>

#include "commands.h"
#include "inspection.h"
#include "model_inspection.h"
#include "nade/io/mesh_file.h"
#include "nade/io/output_file.h"
#include "nade/io/recording.h"

namespace nade::cli {
namespace {

enum class Report { text, json };

struct InspectArguments {
  std::string input;
  Report report = Report::text;
};

Status print(const InspectArguments& arguments, const nlohmann::ordered_json& report,
             std::string (*as_words)(const nlohmann::ordered_json&)) {
  Result<OutputFile> out = OutputFile::create("-", OutputFile::Encoding::plain);
  if (!out) return out.error();
  const Status written =
      out->write(arguments.report == Report::json
                     ? report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"
                     : as_words(report));
  if (!written.ok()) return written;
  return out->finish();
}

Status run_inspect(const InspectArguments& arguments) {
  if (has_mesh_ending(arguments.input)) {
    const auto report = inspect_model(arguments.input);
    if (!report) return report.error();
    return print(arguments, *report, model_as_text);
  }
  Result<RecordingReader> reader = RecordingReader::open(arguments.input);
  if (!reader) return reader.error();
  Inspection inspection;
  while (true) {
    const Result<std::optional<RecordedFrame>> frame = reader->next();
    if (!frame) return frame.error();
    if (!*frame) break;
    inspection.add(**frame);
  }
  return print(arguments, as_json(inspection, *reader), as_text);
}

}  // namespace

void add_inspect(CLI::App& app, Action& action) {
  CLI::App* const command = app.add_subcommand("inspect", "Says what is in a recording or a mesh");
  const auto arguments = std::make_shared<InspectArguments>();
  command
      ->add_option("input", arguments->input,
                   "the recording to read, - is stdin; or a .glb .gltf .obj .stl .ply .off")
      ->type_name("IN")
      ->required();
  command->add_flag_callback(
      "--json", [arguments] { arguments->report = Report::json; },
      "prints one JSON object and nothing else");
  command->callback(
      [&action, arguments] { action = [arguments] { return run_inspect(*arguments); }; });
}

}  // namespace nade::cli
