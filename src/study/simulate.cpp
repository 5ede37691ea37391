#include "nade/study/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <random>
#include <utility>

#include "nade/eval/synth.h"
#include "nade/study/run.h"

namespace nade::study {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kRate_hz = 60.0;
/// So many frames at most wait to be written while nobody needs them drawn.
constexpr std::size_t kFramesAtOnce = 256;

/// Nearly normal, of mean 0 and deviation 1: twelve even numbers added up, which are the same on
/// every machine.
double drawn_normal(std::mt19937_64& generator) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += 0x1p-53 * static_cast<double>(generator() >> 11U);
  return sum;
}

std::optional<double> number_from(std::string_view text) {
  double value = 0.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = code == std::errc{} && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// An object with what is needed to stroke it.
struct Strokable {
  std::string name;
  LoadedObject loaded;
};

/// The motions of a simulated study.
class Motions {
 public:
  static Result<Motions> load(const Plan& plan) {
    Motions motions;
    for (const StudyObject& object : plan.objects) {
      Result<LoadedObject> loaded = load_object(object.spec);
      if (!loaded) return loaded.error();
      motions.objects_.push_back({object.name, std::move(loaded).value()});
    }
    const Result<HandPose> relaxed = load_relaxed_hand(Handedness::right);
    if (!relaxed) return relaxed.error();
    motions.relaxed_ = *relaxed;
    return motions;
  }

  [[nodiscard]] const LoadedObject& object(const std::string& name) const {
    return std::find_if(objects_.begin(), objects_.end(),
                        [&](const Strokable& object) { return object.name == name; })
        ->loaded;
  }
  [[nodiscard]] Result<StrokeSynth> stroke(const std::string& name, std::mt19937_64& generator,
                                           double duration_s) const {
    SynthOptions options;
    options.stroke = static_cast<Stroke>(generator() % 3);
    options.speed_m_per_s = 0.1 + 0.02 * drawn_normal(generator);
    options.depth_m = std::clamp(0.02 + 0.004 * drawn_normal(generator), 0.008, 0.035);
    options.duration_s = duration_s + 1.0;  // coming down is left out
    options.rate_hz = kRate_hz;
    options.noise = NoiseModel::quest;
    options.seed = generator();
    return StrokeSynth::create(object(name), {}, relaxed_, options);
  }

 private:
  std::vector<Strokable> objects_;
  HandPose relaxed_;
};

/// An invented person at the panel.
class InventedPerson {
 public:
  InventedPerson(StudyRun& run, const SimulationOptions& options, const Motions* motions,
                 std::uint64_t seed)
      : run_(&run), options_(&options), motions_(motions), generator_(seed) {
    for (const Question& question : run.session().plan().questions) {
      bias_[question.id] = options.effect.person_spread * drawn_normal(generator_);
    }
  }

  Status take_part() {
    while (!run_->over()) {
      const Status done = go_on();
      if (!done) return done;
    }
    return run_->status();
  }

 private:
  Status go_on() {
    switch (run_->state()) {
      case StudyState::stroking:
        return stroke();
      case StudyState::question:
        answer();
        break;
      case StudyState::ready:
        press(kStartButton);
        break;
      case StudyState::countdown:
        wait(run_->session().remaining_s());
        break;
      default:
        wait(std::max(run_->session().remaining_s(), 0.1));
        press(kContinueButton);
    }
    return ok_status();
  }

  void wait(double seconds) {
    now_ns_ += std::llround(seconds * 1e9);
    RunFrame frame;
    frame.now_ns = now_ns_;
    run_->frame(frame);
  }
  void press(int button) {
    now_ns_ += kSecond_ns / 2;
    run_->press(button, now_ns_);
  }

  void answer() {
    const StudySession& session = run_->session();
    const Scale& scale = session.plan().scale;
    const std::string& id = session.plan().questions[asked_].id;
    const Effect& effect = options_->effect;
    double feeling = effect.baseline + bias_[id] + effect.answer_spread * drawn_normal(generator_);
    const bool corrected = trial_ > 0 && session.trials()[trial_ - 1].method != Method::none;
    const auto shift = effect.shift.find(id);
    if (corrected && shift != effect.shift.end()) feeling += effect.answer_spread * shift->second;
    const double middle = 0.5 * (1.0 + scale.points);
    const int value = static_cast<int>(std::lround(std::clamp(
        middle + effect.points_per_unit * feeling, 1.0, static_cast<double>(scale.points))));
    asked_ = asked_ + 1 < session.plan().questions.size() ? asked_ + 1 : 0;
    wait(std::clamp(3.0 + drawn_normal(generator_), 0.5, 8.0));
    press(kAnswerButton + value);
    press(kConfirmButton);
  }

  Status stroke() {
    const StudyScene scene = run_->scene();
    trial_ = scene.trial;
    asked_ = 0;
    const double length_s = std::min(options_->motion_s, run_->session().plan().trial_s);
    if (motions_ != nullptr && scene.recording) {
      const Status moved = move(scene, length_s);
      if (!moved) return moved;
    }
    wait(run_->session().remaining_s());
    return ok_status();
  }

  /// Strokes for so long, frame by frame.
  Status move(const StudyScene& scene, double length_s) {
    Result<StrokeSynth> synth = motions_->stroke(scene.object, generator_, length_s);
    if (!synth) return synth.error();
    CorrectorOptions corrector_options;
    corrector_options.method = scene.method;
    HandCorrector corrector(corrector_options);
    const Object object = motions_->object(scene.object).placed();
    const std::int64_t begin_ns = now_ns_;
    const auto lead_ns = std::llround(1e9 * synth->stroke_begin_s());
    std::size_t count = 0;
    while (const auto recorded = synth->next()) {
      const std::int64_t time_ns = recorded->time_ns - lead_ns;
      const auto& hand = recorded->hands[1];
      const CorrectedHand* drawn = nullptr;
      if (hand) drawn = &corrector.update(hand->pose, object, recorded->time_ns);
      if (time_ns < 0) continue;
      if (1e-9 * static_cast<double>(time_ns) >= length_s) break;
      now_ns_ = std::max(now_ns_, begin_ns + time_ns);
      RunFrame frame;
      frame.now_ns = now_ns_;
      if (hand) frame.tracked[1] = &hand->pose;
      frame.corrected[1] = drawn;
      run_->frame(frame);
      if (++count % kFramesAtOnce == 0) run_->drain();
    }
    return ok_status();
  }

  StudyRun* run_;
  const SimulationOptions* options_;
  const Motions* motions_;
  std::mt19937_64 generator_;
  std::map<std::string, double> bias_;
  std::int64_t now_ns_ = 0;
  std::size_t trial_ = 0;
  std::size_t asked_ = 0;
};

Status refuse_used_folder(const std::string& folder) {
  std::error_code aside;
  if (!std::filesystem::exists(folder, aside) || std::filesystem::is_empty(folder, aside)) {
    return ok_status();
  }
  return Error{
      ErrorCode::unwritable,
      fmt::format("{}: expected an empty folder for SIMULATED data, found files in it", folder)};
}

}  // namespace

Result<Effect> parse_effect(const std::string& text, const Plan& plan) {
  Effect effect;
  std::map<std::string, double*> numbers{{"person", &effect.person_spread},
                                         {"answer", &effect.answer_spread},
                                         {"baseline", &effect.baseline},
                                         {"points", &effect.points_per_unit}};
  std::string known = "all";
  for (const Question& question : plan.questions) known += ", " + question.id;
  std::optional<double> all;
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::string_view part = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(part.size() + 1, rest.size()));
    const std::size_t equals = std::min(part.find('='), part.size());
    const std::string name(part.substr(0, equals));
    const auto value = number_from(part.substr(std::min(equals + 1, part.size())));
    const bool asks = std::any_of(plan.questions.begin(), plan.questions.end(),
                                  [&](const Question& question) { return question.id == name; });
    if (!value || (name != "all" && !asks && numbers.count(name) == 0)) {
      return Error{ErrorCode::out_of_range,
                   fmt::format("effect: expected NAME=NUMBER with {}, baseline, person, answer or "
                               "points, as in 'all=1,{}=0.5', found '{}'",
                               known, plan.questions.front().id, part)};
    }
    if (name == "all") all = value;
    if (asks) effect.shift[name] = *value;
    if (const auto number = numbers.find(name); number != numbers.end()) *number->second = *value;
  }
  if (!(effect.answer_spread > 0.0) || !(effect.points_per_unit > 0.0) ||
      !(effect.person_spread >= 0.0)) {
    return Error{ErrorCode::out_of_range,
                 "effect: expected answer and points above 0 and person not below 0"};
  }
  for (const Question& question : plan.questions) {
    if (all) effect.shift.emplace(question.id, *all);
  }
  return effect;
}

Status simulate_study(const Plan& plan, const std::string& folder, const SimulationOptions& options,
                      const std::function<void(const std::string&)>& on_participant) {
  const Status fresh = refuse_used_folder(folder);
  if (!fresh) return fresh;
  std::optional<Motions> motions;
  if (options.motion_s > 0.0) {
    Result<Motions> loaded = Motions::load(plan);
    if (!loaded) return loaded.error();
    motions.emplace(std::move(loaded).value());
  }
  for (std::size_t number = 1; number <= options.participants; ++number) {
    RunOptions run;
    run.store.folder = folder;
    run.store.participant = fmt::format("P{:02}", number);
    run.store.tool = options.tool;
    run.store.origin = Origin::simulated;
    run.store.motion = motions ? Motion::recorded : Motion::none;
    run.store.safety = StoreOptions::Safety::quick;
    run.store.wall_clock = [] { return std::string("SIMULATED"); };
    run.source = "SIMULATED";
    if (on_participant) on_participant(run.store.participant);
    const std::uint64_t seed = seed_of(options.seed, run.store.participant);
    Result<std::unique_ptr<StudyRun>> opened = StudyRun::open(plan, std::move(run));
    if (!opened) return opened.error();
    const Status done =
        InventedPerson(**opened, options, motions ? &*motions : nullptr, seed).take_part();
    if (!done) return done;
  }
  return ok_status();
}

}  // namespace nade::study
