#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "nade/io/output_file.h"
#include "nade/io/passing_folder.h"
#include "nade/io/plain_text.h"
#include "nade/study/figure.h"

namespace nade::study {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> kFormats{".svg", ".pdf", ".png"};
constexpr const char* kMessages = "messages";  // gnuplot's

/// How a program ended.
struct Ended {
  int start_error = 0;  ///< why it could not be started; 0 where it was
  int status = 0;
};

/// Runs a script from its folder, so that no path is ever read as a command; the pictures go to
/// `out`, which lies in it.
Ended run_gnuplot(const std::string& folder, const std::string& script, const std::string& out) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addchdir_np(&files, folder.c_str());
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, (out + kMessages).c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  std::string program = "gnuplot";
  std::string defaults = "--default-settings";
  std::string command = "-e";
  std::string set = fmt::format("OUT='{}'", out);
  std::string file = script;
  std::array<char*, 6> arguments{program.data(), defaults.data(), command.data(),
                                 set.data(),     file.data(),     nullptr};
  Ended ended;
  pid_t child = 0;
  ended.start_error = ::posix_spawnp(&child, "gnuplot", &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (ended.start_error != 0) return ended;
  while (::waitpid(child, &ended.status, 0) < 0 && errno == EINTR) {
  }
  return ended;
}

std::string first_message(const std::string& path) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.find_first_not_of(" \t^") != std::string::npos) return line;
  }
  return "no message";
}

/// Why there are no pictures; empty where gnuplot made them all.
std::string problem_of(const Figure& figure, const Ended& ended, const PassingFolder& passing) {
  const std::string pictures = fmt::format("{0}.svg, {0}.pdf and {0}.png", figure.name);
  if (ended.start_error == ENOENT ||
      (WIFEXITED(ended.status) && WEXITSTATUS(ended.status) == 127)) {
    return fmt::format(
        "{} were not drawn, for gnuplot is not installed (Debian: gnuplot-nox); once it is, "
        "'gnuplot {}.gp' draws them",
        pictures, figure.name);
  }
  if (ended.start_error != 0) {
    return fmt::format("{} were not drawn, for gnuplot could not be started: {}", pictures,
                       std::generic_category().message(ended.start_error));
  }
  bool all = WIFEXITED(ended.status) && WEXITSTATUS(ended.status) == 0;
  std::error_code error;
  for (const std::string_view format : kFormats) {
    const auto size = fs::file_size(passing.path(figure.name + std::string(format)), error);
    all = all && !error && size > 0;
  }
  if (all) return {};
  return fmt::format("{} were not drawn, gnuplot said: {}", pictures,
                     first_message(passing.path(kMessages)));
}

}  // namespace

std::string gnuplot_string(std::string_view line) {
  std::string result = "'";
  for (const char character : plain_text(line)) {
    if (character == '\'') result += '\'';
    result += character;
  }
  return result + "'";
}

Result<DrawnFigure> draw_figure(const Figure& figure, const std::string& folder) {
  const std::string stem = (fs::path(folder) / figure.name).string();
  for (const auto& [end, text] : {std::pair{".gp", &figure.script}, {".dat", &figure.data}}) {
    const Status written = write_whole(stem + end, *text);
    if (!written) return written.error();
  }
  const PassingFolder passing(stem + "-XXXXXX");
  if (!passing.there()) {
    return Error{ErrorCode::unwritable, fmt::format("{}: no folder can be made in it", folder)};
  }
  const Ended ended = run_gnuplot(fs::path(".") / folder, figure.name + ".gp",
                                  fs::path(passing.path()).filename().string() + "/");
  DrawnFigure drawn;
  drawn.problem = problem_of(figure, ended, passing);
  if (!drawn.problem.empty()) return drawn;
  for (const std::string_view format : kFormats) {
    std::error_code error;
    const std::string file = figure.name + std::string(format);
    fs::rename(passing.path(file), stem + std::string(format), error);
    if (error) {
      return Error{ErrorCode::unwritable, fmt::format("{}{}: {}", stem, format, error.message())};
    }
    drawn.files.push_back(file);
  }
  return drawn;
}

}  // namespace nade::study
