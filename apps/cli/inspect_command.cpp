#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "batch.h"
#include "commands.h"
#include "console.h"
#include "inspection.h"
#include "model_inspection.h"
#include "nade/io/mesh_file.h"
#include "nade/io/output_file.h"
#include "nade/io/recording.h"

namespace nade::cli {
namespace {

enum class Report { text, json };

struct InspectArguments {
  std::vector<std::string> inputs;
  Report report = Report::text;
  std::size_t jobs = 0;
};

using Inspected = nlohmann::ordered_json;

std::string words_of(const Inspected& inspected, bool is_model) {
  return is_model ? model_as_text(inspected) : as_text(inspected);
}

std::string json_of(const Inspected& inspected, int indent) {
  return inspected.dump(indent, ' ', false, Inspected::error_handler_t::replace) + "\n";
}

Result<Inspected> inspect(const std::string& input) {
  if (has_mesh_ending(input)) return inspect_model(input);
  Result<RecordingReader> reader = RecordingReader::open(input);
  if (!reader) return reader.error();
  Inspection inspection;
  while (true) {
    const Result<std::optional<RecordedFrame>> frame = reader->next();
    if (!frame) return frame.error();
    if (!*frame) break;
    inspection.add(**frame);
  }
  return as_json(inspection, *reader);
}

/// Files as they are, and the recordings of folders.
Result<std::vector<std::string>> files_of(const std::vector<std::string>& inputs) {
  std::vector<std::string> files;
  for (const std::string& input : inputs) {
    std::error_code ignored;
    if (!std::filesystem::is_directory(input, ignored)) {
      files.push_back(input);
      continue;
    }
    const Result<std::vector<std::string>> found = recordings_in(input);
    if (!found) return found.error();
    for (const std::string& name : *found) {
      files.push_back((std::filesystem::path(input) / name).string());
    }
  }
  if (!files.empty()) return files;
  return Error{ErrorCode::not_found,
               fmt::format("{}: expected recordings, found none", fmt::join(inputs, ", "))};
}

/// In the order of their names: words under each name, or a line of JSON each.
Status inspect_many(const InspectArguments& arguments) {
  const Result<std::vector<std::string>> files = files_of(arguments.inputs);
  if (!files) return files.error();
  std::vector<Result<Inspected>> reports(files->size(), Inspected());
  on_threads(arguments.jobs > 0 ? arguments.jobs : cores(), files->size(), "inspected",
             [&](std::size_t index, std::size_t) { reports[index] = inspect((*files)[index]); });
  std::string text;
  std::size_t failed = 0;
  for (std::size_t i = 0; i < files->size(); ++i) {
    const std::string& file = (*files)[i];
    if (!reports[i]) {
      ++failed;
    } else if (arguments.report == Report::json) {
      Inspected line{{"file", file}};
      line.update(*reports[i]);
      text += json_of(line, -1);
    } else {
      text += fmt::format("{}{}\n{}", text.empty() ? "" : "\n", file,
                          words_of(*reports[i], has_mesh_ending(file)));
    }
  }
  if (const Status written = write_whole("-", text); !written) return written;
  for (const Result<Inspected>& report : reports) {
    if (!report) warn(report.error().message);
  }
  if (failed == 0) return ok_status();
  return Error{ErrorCode::bad_value,
               fmt::format("{} of {} files could not be inspected", failed, files->size())};
}

Status run_inspect(const InspectArguments& arguments) {
  const std::string& input = arguments.inputs.front();
  std::error_code ignored;
  if (arguments.inputs.size() > 1 || std::filesystem::is_directory(input, ignored)) {
    return inspect_many(arguments);
  }
  const Result<Inspected> report = inspect(input);
  if (!report) return report.error();
  return write_whole("-", arguments.report == Report::json
                              ? json_of(*report, 2)
                              : words_of(*report, has_mesh_ending(input)));
}

}  // namespace

void add_inspect(CLI::App& app, Action& action) {
  CLI::App* const command = app.add_subcommand("inspect", "Says what is in a recording or a mesh");
  const auto arguments = std::make_shared<InspectArguments>();
  command
      ->add_option("input", arguments->inputs,
                   "the recording to read, - is stdin; or a .glb .gltf .obj .stl .ply .off; or "
                   "several, and folders of recordings")
      ->type_name("IN")
      ->required();
  command->add_flag_callback(
      "--json", [arguments] { arguments->report = Report::json; },
      "prints one JSON object and nothing else; of several files a line each");
  add_jobs_option(*command, arguments->jobs);
  command->callback(
      [&action, arguments] { action = [arguments] { return run_inspect(*arguments); }; });
}

}  // namespace nade::cli
