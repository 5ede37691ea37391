#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bench_choice.h"
#include "commands.h"
#include "figure_pairs.h"
#include "figure_sheet.h"
#include "nade/draw/image.h"
#include "nade/eval/suite.h"
#include "nade/eval/synth.h"
#include "number_options.h"
#include "spooled_input.h"
#include "tracked_check.h"

namespace nade::cli {
namespace {

struct FigureArguments {
  ShowArguments show;  ///< `recording` empty: the bundled strokes
  std::string name;    ///< of the recording, as the person gave it
  std::string output;
  std::vector<std::string> methods;
  std::optional<std::size_t> frame;
  std::optional<double> time_s;
  std::string pairs;  ///< a folder; empty: a sheet is drawn
  std::size_t count = 40;
  std::uint64_t seed = 1;
  double film_s = 0.0;
  std::string filter;
  std::string scenes;
};

/// Where the frames of a row come from, one after another.
using Frames = std::function<Result<std::optional<RecordedFrame>>()>;

Result<std::vector<CorrectorOptions>> corrector_options(const FigureArguments& arguments) {
  std::vector<CorrectorOptions> all;
  for (const std::string& name : arguments.methods) {
    const std::optional<Method> method = method_from_name(name);
    if (!method) {
      return misuse(fmt::format("--method: expected some of {}, parted by commas, found '{}'",
                                method_names(), name));
    }
    MethodOptions options;
    options.corrector.method = *method;
    all.push_back(options_of(options));
  }
  return all;
}

/// Plays the frames to the one at `time_ns`, each method with its own memory.
Status play(const Frames& next, std::int64_t time_ns, const std::array<double, 2>& scale,
            const std::vector<CorrectorOptions>& methods, FigureRow& row) {
  const Object object = row.placed.object();
  std::vector<std::array<HandCorrector, 2>> correctors;
  correctors.reserve(methods.size());
  for (const CorrectorOptions& options : methods) {
    correctors.push_back({HandCorrector(options), HandCorrector(options)});
  }
  row.by_method.resize(methods.size());
  while (true) {
    const Result<std::optional<RecordedFrame>> frame = next();
    if (!frame) return frame.error();
    if (!frame->has_value() || (*frame)->time_ns > time_ns) return ok_status();
    for (std::size_t m = 0; m < methods.size(); ++m) {
      for (std::size_t side = 0; side < 2; ++side) {
        auto& staged = row.by_method[m][side];
        staged.reset();
        if (!(*frame)->hands[side]) continue;
        const HandPose& tracked = (*frame)->hands[side]->pose;
        const CorrectedHand& hand = correctors[m][side].update(tracked, object, (*frame)->time_ns);
        staged =
            draw::StagedHand{tracked, hand.pose, hand.contacts, scale[side], methods[m].method};
      }
    }
  }
}

/// A stroke that comes with nade, at the frame that shows most.
struct BundledStroke {
  const char* title;
  const char* object;
  const char* place;
  /// Of the time that the palm is at its depth.
  double moment;
  double air;
};
constexpr std::array<BundledStroke, 3> kBundled{{{"Plane", "plane", "", 0.30, 0.87},
                                                 {"Sphere", "sphere", "", 0.25, 0.87},
                                                 {"Dog", "dog", "back", 0.26, 1.3}}};
constexpr double kBundledDepth = 0.02;

Result<FigureRow> bundled_row(const BundledStroke& stroke, const draw::HandMeshes& meshes,
                              const std::vector<CorrectorOptions>& methods) {
  Result<LoadedObject> object = load_object(stroke.object);
  if (!object) return object.error();
  SynthOptions options;
  options.place = stroke.place;
  options.depth_m = kBundledDepth;
  options.duration_s = 4.0;
  const Result<HandPose> relaxed = load_relaxed_hand(options.side);
  if (!relaxed) return relaxed.error();
  Result<StrokeSynth> synth = StrokeSynth::create(*object, {}, *relaxed, options);
  if (!synth) return synth.error();
  const double at_s =
      synth->stroke_begin_s() + stroke.moment * (synth->stroke_end_s() - synth->stroke_begin_s());
  const double scale = hand_scale(meshes[index_of(options.side)], *relaxed);
  FigureRow row{stroke.title, stroke.air, {std::move(object).value(), {}}, {}};
  const Frames next = [&synth]() -> Result<std::optional<RecordedFrame>> { return synth->next(); };
  const Status played =
      play(next, static_cast<std::int64_t>(1e9 * at_s), {scale, scale}, methods, row);
  if (!played) return played.error();
  return row;
}

/// The time that is shown of the person's own recording.
Result<std::int64_t> time_of(const FigureArguments& arguments, const Show& show) {
  const std::int64_t first = show.survey.first_ns;
  if (arguments.time_s) {
    const std::int64_t at =
        first + static_cast<std::int64_t>(std::llround(1e9 * *arguments.time_s));
    if (at <= show.survey.last_ns) return at;
    return misuse(fmt::format("--time: expected 0 to {:.3f}, which is how long {} lasts, found {}",
                              1e-9 * static_cast<double>(show.survey.last_ns - first),
                              show.performance.recording, *arguments.time_s));
  }
  if (arguments.frame) {
    const auto time = time_of_frame(show.performance.recording, *arguments.frame);
    if (!time) return time.error();
    if (*time) return **time;
    return misuse(fmt::format("--frame: expected 0 to {}, the frames of {}, found {}",
                              show.survey.frames - 1, show.performance.recording,
                              *arguments.frame));
  }
  return deepest_press(show.survey, show.placed.object()).value_or(first);
}

Result<FigureContent> own_content(const FigureArguments& arguments, Show show,
                                  const std::vector<CorrectorOptions>& methods) {
  if (!show.has_tracked) return not_tracked(show.performance.recording, kTracked);
  const Result<std::int64_t> time = time_of(arguments, show);
  if (!time) return time.error();
  Result<RecordingReader> reader = RecordingReader::open(show.performance.recording);
  if (!reader) return reader.error();
  FigureContent content;
  content.caption = fmt::format("{}, {:.2f} s after its first frame", arguments.name,
                                1e-9 * static_cast<double>(*time - show.survey.first_ns));
  const std::string& spec = show.placed.loaded.spec;
  const std::string title = spec.substr(spec.find_last_of('/') + 1);
  content.rows.push_back({title, 0.92, std::move(show.placed), {}});
  const Status played = play([&reader] { return reader->next(); }, *time, show.survey.scale,
                             methods, content.rows.front());
  if (!played) return played.error();
  return content;
}

Result<FigureContent> bundled_content(const draw::HandMeshes& hands,
                                      const std::vector<CorrectorOptions>& methods) {
  FigureContent content;
  content.caption = fmt::format(
      "A stroke along each object with the palm's skin {:.0f} mm below the surface; plane, sphere "
      "of 150 mm radius, and a dog.",
      1e3 * kBundledDepth);
  for (const BundledStroke& stroke : kBundled) {
    Result<FigureRow> row = bundled_row(stroke, hands, methods);
    if (!row) return row.error();
    content.rows.push_back(std::move(row).value());
  }
  return content;
}

/// The paper explains itself in fewest terms; else the first method that corrects.
std::size_t explained_method(const std::vector<CorrectorOptions>& methods) {
  const auto at = [&methods](auto&& is_it) {
    return static_cast<std::size_t>(std::find_if(methods.begin(), methods.end(), is_it) -
                                    methods.begin());
  };
  const std::size_t paper = at([](const auto& m) { return m.method == Method::paper; });
  if (paper < methods.size()) return paper;
  const std::size_t corrects = at([](const auto& m) { return m.method != Method::none; });
  return corrects < methods.size() ? corrects : 0;
}

Status run_on(const FigureArguments& arguments) {
  Result<std::vector<CorrectorOptions>> methods = corrector_options(arguments);
  if (!methods) return methods.error();
  Result<draw::HandMeshes> hands = load_hands(arguments.show.hands);
  if (!hands) return hands.error();
  for (CorrectorOptions& options : *methods) {
    use_own_hands(arguments.show.hands, *hands, options);
  }
  Result<FigureContent> content = Error{};
  if (arguments.show.recording.empty()) {
    content = bundled_content(*hands, *methods);
  } else {
    Result<Show> show = prepare(arguments.show);
    if (!show) return show.error();
    content = own_content(arguments, std::move(show).value(), *methods);
  }
  if (!content) return content.error();
  content->methods = arguments.methods;
  content->explained = explained_method(*methods);
  content->terms = (*methods)[content->explained].method == Method::paper ? FigureTerms::rays
                                                                          : FigureTerms::skin;
  Result<Studio> studio = open_studio(*hands);
  if (!studio) return studio.error();
  const Result<draw::Image> sheet = draw_figure(*content, *studio);
  if (!sheet) return sheet.error();
  return draw::save_png(arguments.output, *sheet);
}

/// Pairs for people to choose from, in place of a sheet.
Status run_pairs(const FigureArguments& arguments) {
  const std::string methods = arguments.methods.empty()
                                  ? "paper,nade"
                                  : fmt::format("{}", fmt::join(arguments.methods, ","));
  Result<std::vector<ComparedMethod>> chosen = chosen_methods(methods);
  if (!chosen) return chosen.error();
  if (chosen->size() != 2) {
    return misuse(fmt::format("--method '{}': expected two methods to compare in pairs", methods));
  }
  Result<std::vector<std::shared_ptr<const BenchScene>>> scenes = chosen_scenes(arguments.scenes);
  if (!scenes) return scenes.error();
  PairsPlan plan{suite_cases({.scenes = std::move(scenes).value()}),
                 {std::move((*chosen)[0]), std::move((*chosen)[1])},
                 arguments.count,
                 arguments.seed,
                 arguments.film_s,
                 arguments.pairs};
  std::erase_if(plan.cases, [&](const SuiteCase& suite_case) {
    return suite_case.name().find(arguments.filter) == std::string::npos;
  });
  if (plan.cases.empty()) {
    return misuse(fmt::format("--filter '{}': no case has that in its name", arguments.filter));
  }
  const Result<DrawnHands> hands = load_drawn_hands();
  if (!hands) return hands.error();
  Result<Studio> studio = open_studio(hands->meshes);
  if (!studio) return studio.error();
  return draw_pairs(plan, *hands, *studio);
}

Status run_figure(FigureArguments arguments) {
  if (!arguments.pairs.empty()) return run_pairs(arguments);
  if (arguments.output.empty()) return misuse("--output is required");
  if (arguments.methods.empty()) arguments.methods = {"nade"};
  const ObjectOptions& object = arguments.show.object;
  const bool own = !arguments.show.recording.empty();
  if (!own && (object.object || object.at || object.turn || object.scale ||
               arguments.show.press_m || arguments.frame || arguments.time_s)) {
    return misuse(
        "the bundled strokes have their objects: expected a recording IN before "
        "--object, --at, --turn, --scale, --press, --frame or --time");
  }
  if (arguments.frame && arguments.time_s) return misuse("--frame and --time exclude each other");
  const Status png = check_png("--output", arguments.output);
  if (!png) return png;
  const Status apart = check_apart(arguments.output, arguments.show);
  if (!apart) return apart;
  if (!own) return run_on(arguments);
  const Result<SpooledInput> recording = SpooledInput::open(arguments.show.recording);
  if (!recording) return recording.error();
  arguments.name = recording->name();
  arguments.show.recording = recording->path();
  return named(run_on(arguments), *recording);
}

void add_pairs_options(CLI::App& command, FigureArguments& arguments) {
  CLI::Option* const pairs =
      command
          .add_option("--pairs", arguments.pairs,
                      "in place of a sheet: pairs of pictures by two methods, to be compared blind")
          ->type_name("DIR");
  for (const char* const other : {"input", "--output", "--frame", "--time", "--object", "--at",
                                  "--turn", "--scale", "--press", "--hand-left", "--hand-right"}) {
    pairs->excludes(command.get_option(other));
  }
  command.add_option("--count", arguments.count, "how many pairs (default 40)")
      ->type_name("N")
      ->transform(whole_number_in(1, 1000))
      ->needs(pairs);
  command
      .add_option("--seed", arguments.seed,
                  "of the cases, the moments and which is left (default 1)")
      ->type_name("N")
      ->transform(whole_number())
      ->needs(pairs);
  command
      .add_option("--films", arguments.film_s,
                  "also films of so long a time around each moment (needs ffmpeg)")
      ->type_name("S")
      ->check(number_in(0.1, 60.0))
      ->needs(pairs);
  command.add_option("--filter", arguments.filter, "only bench cases with this in their names")
      ->type_name("TEXT")
      ->needs(pairs);
  command
      .add_option("--scenes", arguments.scenes,
                  "a folder of scenes, or none (default those that come with nade)")
      ->type_name("DIR")
      ->needs(pairs);
}

}  // namespace

void add_figure(CLI::App& app, Action& action) {
  CLI::App* const command = app.add_subcommand(
      "figure", "Draws a sheet: object, hand without and with correction, explained");
  const auto arguments = std::make_shared<FigureArguments>();
  command
      ->add_option("input", arguments->show.recording,
                   "a recording of your own; - is stdin (default strokes of plane, sphere and dog)")
      ->type_name("IN");
  command->add_option("-o,--output", arguments->output, "the picture to write")
      ->type_name("SHEET.png");
  command
      ->add_option(
          "--method", arguments->methods,
          "what column (iii) shows (default nade); several, parted by commas, give several "
          "columns. Of pairs the two to compare (default paper,nade)")
      ->type_name(method_names())
      ->delimiter(',');
  command->add_option("--frame", arguments->frame, "of this frame, from 0 (default the deepest)")
      ->type_name("N")
      ->transform(whole_number());
  command->add_option("--time", arguments->time_s, "so long after the first frame")
      ->type_name("S")
      ->check(number_in(0.0, 1e6));
  add_show_options(*command, arguments->show);
  add_pairs_options(*command, *arguments);
  command->callback(
      [&action, arguments] { action = [arguments] { return run_figure(*arguments); }; });
}

}  // namespace nade::cli
