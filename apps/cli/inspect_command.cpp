#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "batch.h"
#include "command_files.h"
#include "commands.h"
#include "console.h"
#include "inspection.h"
#include "model_inspection.h"
#include "nade/io/mesh_file.h"
#include "nade/io/output_file.h"
#include "nade/io/recording.h"
#if defined(NADE_CLI_STUDY)
#include "recording_plot.h"
#endif

namespace nade::cli {
namespace {

enum class Report { text, json };

struct InspectArguments {
  std::vector<std::string> inputs;
  Report report = Report::text;
  std::size_t jobs = 0;
  std::optional<std::string> plot;
};

using Inspected = nlohmann::ordered_json;

std::string words_of(const Inspected& inspected, bool is_model) {
  return is_model ? model_as_text(inspected) : as_text(inspected);
}

std::string json_of(const Inspected& inspected, int indent) {
  return inspected.dump(indent, ' ', false, Inspected::error_handler_t::replace) + "\n";
}

/// `also` gets each frame of a recording.
template <class Also>
Result<Inspected> inspect(const std::string& input, Also&& also) {
  if (has_mesh_ending(input)) return inspect_model(input);
  Result<RecordingReader> reader = RecordingReader::open(input);
  if (!reader) return reader.error();
  Inspection inspection;
  while (true) {
    const Result<std::optional<RecordedFrame>> frame = reader->next();
    if (!frame) return frame.error();
    if (!*frame) break;
    inspection.add(**frame);
    also(**frame);
  }
  return as_json(inspection, *reader);
}

Result<Inspected> inspect(const std::string& input) {
  return inspect(input, [](const RecordedFrame&) {});
}

#if defined(NADE_CLI_STUDY)
Status check_plot(const InspectArguments& arguments) {
  std::error_code ignored;
  if (arguments.inputs.size() > 1 ||
      std::filesystem::is_directory(arguments.inputs.front(), ignored) ||
      has_mesh_ending(arguments.inputs.front())) {
    return misuse("--plot: expected one recording");
  }
  const std::string ending = ending_of(*arguments.plot);
  if (ending == ".svg" || ending == ".pdf" || ending == ".png") return ok_status();
  return misuse(fmt::format("--plot: expected a name ending in .svg, .pdf or .png, found '{}'",
                            *arguments.plot));
}

Result<Inspected> inspect_and_plot(const InspectArguments& arguments) {
  const Status checked = check_plot(arguments);
  if (!checked) return checked.error();
  const std::string& input = arguments.inputs.front();
  const Status apart = check_apart({{"--plot", arguments.plot}}, {{"IN", input}});
  if (!apart) return apart.error();
  RecordingPlot plot;
  Result<Inspected> report = inspect(input, [&](const RecordedFrame& frame) { plot.add(frame); });
  if (!report) return report;
  const std::string title = input == kStandardStream
                                ? std::string("standard input")
                                : std::filesystem::path(input).filename().string();
  const Status drawn = plot.draw(title, *arguments.plot);
  if (!drawn) return drawn.error();
  return report;
}
#else
Result<Inspected> inspect_and_plot(const InspectArguments& arguments) {
  return inspect(arguments.inputs.front());
}
#endif

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
  if (!arguments.plot &&
      (arguments.inputs.size() > 1 || std::filesystem::is_directory(input, ignored))) {
    return inspect_many(arguments);
  }
  const Result<Inspected> report = arguments.plot ? inspect_and_plot(arguments) : inspect(input);
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
#if defined(NADE_CLI_STUDY)
  command
      ->add_option("--plot", arguments->plot,
                   "draws a page about one recording, with gnuplot: .svg, .pdf or .png")
      ->type_name("FILE");
#endif
  add_jobs_option(*command, arguments->jobs);
  command->callback(
      [&action, arguments] { action = [arguments] { return run_inspect(*arguments); }; });
}

}  // namespace nade::cli
