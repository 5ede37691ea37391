#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "camera_options.h"
#include "commands.h"
#include "console.h"
#include "nade/draw/film.h"
#include "number_options.h"
#include "show.h"
#include "spooled_input.h"

namespace nade::cli {
namespace {

struct RenderArguments {
  ShowArguments show;
  std::string output;
  CameraOptions camera;
  PictureSize size;
  draw::Overlays overlays;
  std::optional<draw::Shown> shown;
  std::optional<std::size_t> frame;
  std::optional<double> time_s;
  std::optional<double> from_s;
  std::optional<double> to_s;
  double fps = 30.0;
  double slow = 1.0;
};

enum class OutputKind : std::uint8_t { picture, sequence, film };

/// A name with the place for a number in it: "walk-%05d.png".
struct NumberedName {
  std::string before;
  int digits = 0;
  std::string after;

  [[nodiscard]] std::string at(std::size_t number) const {
    return fmt::format("{}{:0{}}{}", before, number, digits, after);
  }
};

/// The last place for a number; other percent signs are letters like any.
std::optional<NumberedName> numbered(const std::string& name) {
  for (std::size_t percent = name.rfind('%'); percent != std::string::npos;
       percent = percent == 0 ? std::string::npos : name.rfind('%', percent - 1)) {
    std::size_t end = percent + 1;
    NumberedName parts{name.substr(0, percent), 0, {}};
    for (; end < name.size() && name[end] >= '0' && name[end] <= '9'; ++end) {
      parts.digits = std::min(10 * parts.digits + (name[end] - '0'), 20);
    }
    if (end == name.size() || name[end] != 'd') continue;
    parts.after = name.substr(end + 1);
    return parts;
  }
  return std::nullopt;
}

Result<OutputKind> kind_of(const RenderArguments& arguments) {
  const std::string& name = arguments.output;
  const bool still = arguments.frame || arguments.time_s;
  const bool stretch = arguments.from_s || arguments.to_s;
  if (arguments.frame && arguments.time_s) return misuse("--frame and --time exclude each other");
  if (name.ends_with(".mp4") || (name.ends_with(".png") && numbered(name))) {
    if (still) return misuse("--frame and --time are for one picture: expected --from and --to");
    return name.ends_with(".mp4") ? OutputKind::film : OutputKind::sequence;
  }
  if (!name.ends_with(".png")) {
    return misuse(
        fmt::format("--output: expected a name ending in .png or .mp4, or with a number as in "
                    "OUT-%05d.png, found '{}'",
                    name));
  }
  if (stretch) return misuse("--from and --to are for films and numbered pictures");
  return OutputKind::picture;
}

std::int64_t nanoseconds(double seconds) {
  return static_cast<std::int64_t>(std::llround(seconds * 1e9));
}

/// Times of the recording that are shown.
struct Stretch {
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
};

Result<Stretch> stretch_of(const RenderArguments& arguments, const Survey& survey) {
  Stretch stretch{survey.first_ns, survey.last_ns};
  if (arguments.from_s) stretch.from_ns = survey.first_ns + nanoseconds(*arguments.from_s);
  if (arguments.to_s) {
    stretch.to_ns = std::min(stretch.to_ns, survey.first_ns + nanoseconds(*arguments.to_s));
  }
  if (stretch.from_ns > stretch.to_ns || stretch.from_ns > survey.last_ns) {
    const double length_s = 1e-9 * static_cast<double>(survey.last_ns - survey.first_ns);
    return misuse(
        fmt::format("--from, --to: expected times in order, from 0 to {:.3f}, which is "
                    "how long {} lasts",
                    length_s, arguments.show.recording));
  }
  return stretch;
}

/// The time of one picture: as asked, or the deepest press.
Result<Stretch> moment_of(const RenderArguments& arguments, const Show& show) {
  std::optional<std::int64_t> time = deepest_press(show.survey, show.placed.object());
  if (arguments.frame) {
    const auto found = time_of_frame(arguments.show.recording, *arguments.frame);
    if (!found) return found.error();
    time = *found;
    if (!time) {
      return misuse(fmt::format("--frame: expected 0 to {}, the frames of {}, found {}",
                                show.survey.frames - 1, arguments.show.recording,
                                *arguments.frame));
    }
  }
  if (arguments.time_s) {
    time = show.survey.first_ns + nanoseconds(*arguments.time_s);
    if (*time > show.survey.last_ns) {
      return misuse(
          fmt::format("--time: expected 0 to {:.3f}, which is how long {} lasts, found {}",
                      1e-9 * static_cast<double>(show.survey.last_ns - show.survey.first_ns),
                      arguments.show.recording, *arguments.time_s));
    }
  }
  const std::int64_t at = time.value_or(show.survey.first_ns);
  return Stretch{at, at};
}

/// Draws a performance at one time after another.
class Projector {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Projector>> create(const RenderArguments& arguments,
                                                                 Show& show,
                                                                 const Stretch& stretch) {
    Result<MomentReader> reader = MomentReader::open(show.performance, show.placed);
    if (!reader) return reader.error();
    Result<Studio> studio = open_studio(show.hands);
    if (!studio) return studio.error();
    const Status set = set_object(*studio, show.placed);
    if (!set) return set.error();
    std::vector<Glimpse> glimpses;
    for (const Glimpse& glimpse : show.survey.glimpses) {
      if (glimpse.time_ns >= stretch.from_ns && glimpse.time_ns <= stretch.to_ns) {
        glimpses.push_back(glimpse);
      }
    }
    if (glimpses.empty()) glimpses = show.survey.glimpses;
    return std::unique_ptr<Projector>(new Projector(arguments, show, std::move(studio).value(),
                                                    std::move(reader).value(),
                                                    CameraPlan(arguments.camera, glimpses)));
  }

  /// Times must not decrease.
  [[nodiscard]] Result<draw::Image> picture(std::int64_t time_ns) {
    Result<Moment> moment = moments_.at(time_ns);
    if (!moment) return moment.error();
    placed_->move_to(time_ns);
    draw::StageFrame frame;
    frame.hands = moment->hands;
    frame.shown = arguments_->shown.value_or(draw::Shown::corrected);
    frame.overlays = arguments_->overlays;
    frame.softness_m = softness_m_;
    const PictureSize& size = arguments_->size;
    frame.pixel_scale = static_cast<float>(size.height) / 720.0F;
    const draw::Camera camera = plan_.at(time_ns, size.aspect());
    draw::Scene scene = studio_.stage.arrange(frame);
    // Who looks from below wants to see the object, not the floor's underside.
    scene.floor = scene.floor && camera.pose.position.y() > scene.floor_y;
    return studio_.renderer->picture(scene, camera, size.width, size.height);
  }

 private:
  Projector(const RenderArguments& arguments, Show& show, Studio studio, MomentReader reader,
            CameraPlan plan)
      : arguments_(&arguments),
        placed_(&show.placed),
        softness_m_(show.softness_m),
        studio_(std::move(studio)),
        moments_(std::move(reader)),
        plan_(std::move(plan)) {}

  const RenderArguments* arguments_;
  PlacedObject* placed_;
  double softness_m_;
  Studio studio_;
  MomentSampler moments_;
  CameraPlan plan_;
};

/// Gives each picture of a stretch to `take`, with its number.
template <class Take>
Status project(const RenderArguments& arguments, Projector& projector, const Stretch& stretch,
               const Take& take) {
  const double step_ns = 1e9 / (arguments.fps * arguments.slow);
  const auto length_ns = static_cast<double>(stretch.to_ns - stretch.from_ns);
  const auto count = static_cast<std::size_t>(length_ns / step_ns) + 1;
  Progress progress("drew", count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto offset = static_cast<std::int64_t>(static_cast<double>(i) * step_ns);
    Result<draw::Image> picture = projector.picture(stretch.from_ns + offset);
    if (!picture) return picture.error();
    const Status taken = take(i, std::move(picture).value());
    if (!taken) return taken;
    progress.step();
  }
  return ok_status();
}

Status render_film(const RenderArguments& arguments, Projector& projector, const Stretch& stretch) {
  Result<draw::FilmWriter> film = draw::FilmWriter::create(
      arguments.output, {arguments.size.width, arguments.size.height, arguments.fps});
  if (!film) return film.error();
  const Status drawn =
      project(arguments, projector, stretch,
              [&film](std::size_t, draw::Image picture) { return film->add(std::move(picture)); });
  return drawn ? film->finish() : drawn;
}

Status render_sequence(const RenderArguments& arguments, Projector& projector,
                       const Stretch& stretch) {
  const NumberedName name = *numbered(arguments.output);
  return project(arguments, projector, stretch,
                 [&name](std::size_t number, const draw::Image& picture) {
                   return draw::save_png(name.at(number), picture);
                 });
}

Status render_picture(const RenderArguments& arguments, Projector& projector,
                      const Stretch& stretch) {
  const Result<draw::Image> picture = projector.picture(stretch.from_ns);
  if (!picture) return picture.error();
  return draw::save_png(arguments.output, *picture);
}

Status run_on(const RenderArguments& arguments) {
  const Result<OutputKind> kind = kind_of(arguments);
  if (!kind) return kind.error();
  Result<Show> show = prepare(arguments.show);
  if (!show) return show.error();
  if (!show->has_tracked && arguments.shown && *arguments.shown != draw::Shown::corrected) {
    return misuse(
        fmt::format("--show: {} is a corrected recording alone: expected corrected, or "
                    "the tracked recording before it",
                    arguments.show.recording));
  }
  const Result<Stretch> stretch = *kind == OutputKind::picture
                                      ? moment_of(arguments, *show)
                                      : stretch_of(arguments, show->survey);
  if (!stretch) return stretch.error();
  const auto projector = Projector::create(arguments, *show, *stretch);
  if (!projector) return projector.error();
  switch (*kind) {
    case OutputKind::film:
      return render_film(arguments, **projector, *stretch);
    case OutputKind::sequence:
      return render_sequence(arguments, **projector, *stretch);
    case OutputKind::picture:
      break;
  }
  return render_picture(arguments, **projector, *stretch);
}

Status run_render(RenderArguments arguments) {
  if (arguments.show.recording == kStandardStream && arguments.show.corrected == kStandardStream) {
    return misuse("IN and CORRECTED cannot both be standard input");
  }
  const std::optional<Vec3>& eye = arguments.camera.eye;
  const std::optional<Vec3>& target = arguments.camera.target;
  if (eye && target && (*eye - *target).norm() < 0.001) {
    return misuse("--eye, --target: expected two places apart, found the same");
  }
  const Status method = check_method(arguments.show.method, MethodChange::never);
  if (!method) return method;
  const Status apart = check_apart(arguments.output, arguments.show);
  if (!apart) return apart;
  const Result<SpooledInput> recording = SpooledInput::open(arguments.show.recording);
  if (!recording) return recording.error();
  arguments.show.recording = recording->path();
  if (!arguments.show.corrected) return named(run_on(arguments), *recording);
  const Result<SpooledInput> corrected = SpooledInput::open(*arguments.show.corrected);
  if (!corrected) return corrected.error();
  arguments.show.corrected = corrected->path();
  return named(named(run_on(arguments), *recording), *corrected);
}

void add_time_options(CLI::App& command, RenderArguments& arguments) {
  const auto add_seconds = [&command](const char* name, std::optional<double>& value,
                                      const char* help) {
    command.add_option(name, value, help)->type_name("S")->check(number_in(0.0, 1e6));
  };
  command
      .add_option("--frame", arguments.frame,
                  "one picture: of this frame, from 0 (default the deepest press)")
      ->type_name("N")
      ->transform(whole_number());
  add_seconds("--time", arguments.time_s, "one picture: so long after the first frame");
  add_seconds("--from", arguments.from_s, "film or numbered pictures: from here");
  add_seconds("--to", arguments.to_s, "film or numbered pictures: up to here");
  command.add_option("--fps", arguments.fps, "pictures a second")
      ->type_name("N")
      ->check(number_in(1.0, 240.0))
      ->capture_default_str();
  command.add_option("--slow", arguments.slow, "how many times slower than it was")
      ->type_name("X")
      ->check(number_in(0.01, 1000.0))
      ->capture_default_str();
}

}  // namespace

void add_render(CLI::App& app, Action& action) {
  CLI::App* const command =
      app.add_subcommand("render", "Draws a recording: a picture, numbered pictures or a film");
  const auto arguments = std::make_shared<RenderArguments>();
  command->add_option("input", arguments->show.recording, "the recording; - is stdin")
      ->type_name("IN")
      ->required();
  command
      ->add_option("corrected", arguments->show.corrected,
                   "what became of it; without it, it is corrected while it is drawn")
      ->type_name("CORRECTED");
  command
      ->add_option("-o,--output", arguments->output,
                   "OUT.png, OUT-%05d.png for one a picture, or OUT.mp4")
      ->type_name("OUT")
      ->required();
  add_show_options(*command, arguments->show);
  add_time_options(*command, *arguments);
  add_camera_options(*command, arguments->camera);
  add_show_option(*command, arguments->shown);
  add_overlay_option(*command, arguments->overlays);
  add_size_option(*command, arguments->size);
  add_method_options(*command, arguments->show.method);
  command->footer(
      "Object and placing are those of the recording's header, where it has them and they are not\n"
      "given.");
  command->callback(
      [&action, arguments] { action = [arguments] { return run_render(*arguments); }; });
}

}  // namespace nade::cli
