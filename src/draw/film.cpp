#include "nade/draw/film.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <condition_variable>
#include <cstdio>
#include <cstring>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "nade/assert.h"
#include "nade/io/output_file.h"

namespace nade::draw {
namespace {

constexpr std::size_t kWaiting = 3;
/// The encoder's end of the file that the film is made in: one without a name.
constexpr int kFilmDescriptor = 3;

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

Error system_error(const std::string& path, const char* what, int error_number) {
  return {ErrorCode::unwritable,
          fmt::format("{}: {}: {}", path, what, std::strerror(error_number))};
}

std::vector<std::string> encoder_arguments(const FilmFormat& format) {
  return {"ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-y",
          // what comes in
          "-f", "rawvideo", "-pixel_format", "rgba", "-video_size",
          fmt::format("{}x{}", format.width, format.height), "-framerate",
          fmt::format("{}", format.frames_a_second), "-i", "pipe:0",
          // what goes out
          "-vf", "scale=out_color_matrix=bt709:out_range=tv", "-c:v", "libx264", "-preset",
          "veryfast", "-crf", "18", "-pix_fmt", "yuv420p", "-colorspace", "bt709",
          "-color_primaries", "bt709", "-color_trc", "bt709", "-movflags", "+faststart", "-f",
          "mp4", fmt::format("/dev/fd/{}", kFilmDescriptor)};
}

/// The last line an encoder said.
std::string last_line(std::FILE* said) {
  std::rewind(said);
  std::array<char, 512> line{};
  std::string last = "it gave no reason";
  while (std::fgets(line.data(), static_cast<int>(line.size()), said) != nullptr) {
    std::string text(line.data());
    while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
    if (!text.empty()) last = text;
  }
  return last;
}

/// Whole or an error number; 0 where all was written.
int write_all(int descriptor, const std::vector<std::uint8_t>& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t wrote = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (wrote < 0 && errno != EINTR) return errno;
    if (wrote > 0) done += static_cast<std::size_t>(wrote);
  }
  return 0;
}

}  // namespace

struct FilmWriter::Impl {
  std::string path;
  FilmFormat format;
  std::optional<OutputFile> output;  ///< made first: a bad name need not wait for the film
  File film;
  File said;
  pid_t encoder = -1;
  int pipe = -1;

  std::thread writer;
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<Image> waiting;
  bool ended = false;
  int failure = 0;

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (encoder < 0) return;
    ::kill(encoder, SIGKILL);
    static_cast<void>(stop());
  }

  Status start();
  Status spawn(int read_end);
  void write_pictures();
  int stop();
  Status copy_film();
};

Status FilmWriter::Impl::start() {
  Result<OutputFile> file = OutputFile::create(path, OutputFile::Encoding::plain);
  if (!file) return file.error();
  output = std::move(file).value();
  film = File(std::tmpfile());
  said = File(std::tmpfile());
  if (film == nullptr || said == nullptr) {
    return system_error(path, "no room for the film while it is made", errno);
  }
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return system_error(path, "no pipe", errno);
  const Status spawned = spawn(ends[0]);
  ::close(ends[0]);
  if (!spawned) {
    ::close(ends[1]);
    return spawned;
  }
  pipe = ends[1];
  writer = std::thread([this] { write_pictures(); });
  return ok_status();
}

Status FilmWriter::Impl::spawn(int read_end) {
  std::vector<std::string> arguments = encoder_arguments(format);
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  // Moved out of the way first: any of them may be the very number another is to become.
  const std::array<int, 3> sources{::fcntl(read_end, F_DUPFD_CLOEXEC, 10),
                                   ::fcntl(::fileno(said.get()), F_DUPFD_CLOEXEC, 10),
                                   ::fcntl(::fileno(film.get()), F_DUPFD_CLOEXEC, 10)};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, sources[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, sources[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, sources[1], STDERR_FILENO);
  posix_spawn_file_actions_adddup2(&actions, sources[2], kFilmDescriptor);
  const int failed =
      ::posix_spawnp(&encoder, "ffmpeg", &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  for (const int source : sources) ::close(source);
  if (failed == 0) return ok_status();
  encoder = -1;
  if (failed == ENOENT) {
    return Error{ErrorCode::not_found,
                 fmt::format("{}: films need the program ffmpeg, which is not installed "
                             "(apt-get install ffmpeg); pictures (.png) do not",
                             path)};
  }
  return system_error(path, "ffmpeg cannot be started", failed);
}

void FilmWriter::Impl::write_pictures() {
  // An encoder that ended shows as an error of write, not as the end of this program.
  sigset_t broken_pipe;
  sigemptyset(&broken_pipe);
  sigaddset(&broken_pipe, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &broken_pipe, nullptr);
  while (true) {
    Image picture;
    {
      std::unique_lock lock(mutex);
      changed.wait(lock, [this] { return ended || !waiting.empty(); });
      if (waiting.empty()) return;
      picture = std::move(waiting.front());
      waiting.pop_front();
    }
    changed.notify_all();
    const int failed = write_all(pipe, picture.rgba);
    if (failed != 0) {
      const std::lock_guard lock(mutex);
      failure = failed;
      changed.notify_all();
      return;
    }
  }
}

/// The encoder's exit status once it has all pictures.
int FilmWriter::Impl::stop() {
  {
    const std::lock_guard lock(mutex);
    ended = true;
  }
  changed.notify_all();
  if (writer.joinable()) writer.join();
  ::close(pipe);
  int status = -1;
  while (::waitpid(encoder, &status, 0) < 0 && errno == EINTR) {
  }
  encoder = -1;
  return status;
}

Status FilmWriter::Impl::copy_film() {
  std::rewind(film.get());
  std::vector<char> block(std::size_t{1} << 20);
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), film.get())) {
    const Status written = output->write({block.data(), count});
    if (!written) return written;
  }
  if (std::ferror(film.get()) != 0) return system_error(path, "cannot be read back", EIO);
  return output->finish();
}

FilmWriter::FilmWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
FilmWriter::FilmWriter(FilmWriter&&) noexcept = default;
FilmWriter& FilmWriter::operator=(FilmWriter&&) noexcept = default;
FilmWriter::~FilmWriter() = default;

Result<FilmWriter> FilmWriter::create(const std::string& path, const FilmFormat& format) {
  if (format.width < 2 || format.height < 2 || format.width % 2 != 0 || format.height % 2 != 0) {
    return Error{ErrorCode::out_of_range,
                 fmt::format("{}: expected an even width and height of a film, found {}x{}", path,
                             format.width, format.height)};
  }
  auto impl = std::make_unique<Impl>();
  impl->path = path;
  impl->format = format;
  const Status started = impl->start();
  if (!started) return started.error();
  return FilmWriter(std::move(impl));
}

Status FilmWriter::add(Image picture) {
  NADE_ASSERT(picture.width == impl_->format.width && picture.height == impl_->format.height);
  std::unique_lock lock(impl_->mutex);
  impl_->changed.wait(lock,
                      [this] { return impl_->waiting.size() < kWaiting || impl_->failure != 0; });
  if (impl_->failure != 0) {
    lock.unlock();
    static_cast<void>(impl_->stop());
    return Error{ErrorCode::unwritable, fmt::format("{}: ffmpeg could not encode it: {}",
                                                    impl_->path, last_line(impl_->said.get()))};
  }
  impl_->waiting.push_back(std::move(picture));
  lock.unlock();
  impl_->changed.notify_all();
  return ok_status();
}

Status FilmWriter::finish() {
  const int status = impl_->stop();
  if (status != 0 || impl_->failure != 0) {
    return Error{ErrorCode::unwritable, fmt::format("{}: ffmpeg could not encode it: {}",
                                                    impl_->path, last_line(impl_->said.get()))};
  }
  return impl_->copy_film();
}

}  // namespace nade::draw
