#include "nade/study/session.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nade/assert.h"

namespace nade::study {
namespace {

using What = StudyEvent::What;
using Fate = StudyProgress::Fate;

/// A press that was meant for the view before.
constexpr std::int64_t kSettle_ns = 200'000'000;
constexpr double kNanosecond_s = 1e-9;
constexpr std::size_t kEventsAtOnce = 16;

}  // namespace

StudySession::StudySession(Plan plan, std::vector<Trial> trials, StudyProgress progress)
    : plan_(std::move(plan)), trials_(std::move(trials)), progress_(std::move(progress)) {
  if (progress_.trials.empty()) progress_.trials.resize(trials_.size(), Fate::open);
  if (progress_.attempts.empty()) progress_.attempts.resize(trials_.size(), 0);
  NADE_ASSERT(progress_.trials.size() == trials_.size());
  NADE_ASSERT(progress_.attempts.size() == trials_.size());
  events_.reserve(kEventsAtOnce);
  const bool begun_before = progress_.practised || next_open() > 0 ||
                            std::any_of(progress_.attempts.begin(), progress_.attempts.end(),
                                        [](std::size_t attempts) { return attempts > 0; });
  if (begun_before) {
    progress_.practised = true;
    to_next(0);
  } else {
    enter(StudyState::instructions, 0);
  }
}

void StudySession::advance(std::int64_t now_ns) {
  if (!begun_) {
    begun_ = true;
    since_ns_ = last_view_ns_ = now_ns_ = now_ns;
  }
  now_ns_ = std::max(now_ns_, now_ns);
  if (state_ == StudyState::countdown && remaining_s() <= 0.0) begin_stroking(now_ns_);
  if (state_ == StudyState::stroking && remaining_s() <= 0.0) end_stroking(now_ns_);
  if (static_cast<int>(std::ceil(remaining_s())) != shown_seconds_) build_view();
}

void StudySession::press(int button, std::int64_t now_ns) {
  advance(now_ns);
  if (now_ns_ - last_view_ns_ < kSettle_ns) return;
  bool enabled = false;
  for (const auto& row : view_.rows) {
    for (const PanelButton& shown : row) enabled = enabled || (shown.id == button && shown.enabled);
  }
  if (!enabled) return;
  if (state_ == StudyState::question) return press_in_question(button, now_ns_);
  if (button == kPractiseAgainButton) return ready(kPractice, now_ns_);
  if (state_ == StudyState::ready) return begin_trial(now_ns_);
  to_next(now_ns_);
}

void StudySession::pause(std::int64_t now_ns) {
  advance(now_ns);
  if (over() || state_ == StudyState::paused) return;
  if (state_ == StudyState::question) leave_question(now_ns_);
  before_pause_ = state_;
  const bool in_trial = state_ == StudyState::countdown || state_ == StudyState::stroking;
  if (in_trial) break_off(now_ns_);
  note(What::paused, now_ns_);
  enter(StudyState::paused, now_ns_);
}

void StudySession::resume(std::int64_t now_ns) {
  advance(now_ns);
  if (state_ != StudyState::paused) return;
  note(What::resumed, now_ns_);
  const bool in_trial =
      before_pause_ == StudyState::countdown || before_pause_ == StudyState::stroking;
  if (in_trial) return ready(trial_, now_ns_);
  enter(before_pause_, now_ns_);
}

void StudySession::repeat(std::int64_t now_ns) {
  advance(now_ns);
  if (over()) return;
  if (state_ == StudyState::paused) resume(now_ns_);
  const bool between = state_ == StudyState::ready || state_ == StudyState::rest;
  if (state_ == StudyState::instructions) return;
  if (between && !practising()) {
    if (!last_done_) return;
    trial_ = *last_done_;
    progress_.trials[trial_] = Fate::open;
    if (done_since_rest_ > 0) --done_since_rest_;
  }
  break_off(now_ns_);
  if (!practising()) note(What::repeated, now_ns_);
  ready(trial_, now_ns_);
}

void StudySession::skip(const std::string& reason, std::int64_t now_ns) {
  advance(now_ns);
  if (over()) return;
  if (state_ == StudyState::paused) resume(now_ns_);
  if (state_ == StudyState::instructions || state_ == StudyState::rest) return to_next(now_ns_);
  break_off(now_ns_);
  note(What::skipped, now_ns_);
  events_.back().reason = reason;
  if (practising()) {
    progress_.practised = true;
    return to_next(now_ns_);
  }
  progress_.trials[trial_] = Fate::skipped;
  to_next(now_ns_);
}

void StudySession::stop(std::int64_t now_ns) {
  advance(now_ns);
  if (over()) return;
  break_off(now_ns_);
  note(What::stopped, now_ns_);
  enter(StudyState::stopped, now_ns_);
}

void StudySession::fail(const std::string& sentence) {
  failure_ = sentence;
  enter(StudyState::failed, now_ns_);
}

bool StudySession::over() const {
  return state_ == StudyState::thanks || state_ == StudyState::stopped ||
         state_ == StudyState::failed;
}

double StudySession::remaining_s() const {
  // In whole nanoseconds, so that who waits for what remains has waited long enough.
  const std::int64_t left_ns = std::llround(length_s() / kNanosecond_s) - (now_ns_ - since_ns_);
  return kNanosecond_s * static_cast<double>(std::max<std::int64_t>(left_ns, 0));
}

/// How long the state lasts by itself.
double StudySession::length_s() const {
  switch (state_) {
    case StudyState::countdown:
      return plan_.countdown_s;
    case StudyState::stroking:
      return trial_s();
    case StudyState::rest:
      return plan_.rest ? plan_.rest->at_least_s : 0.0;
    default:
      return 0.0;
  }
}

double StudySession::trial_s() const {
  return practising() && plan_.practice ? plan_.practice->duration_s : plan_.trial_s;
}

Trial StudySession::current() const {
  if (!practising()) return trials_[trial_];
  if (!plan_.practice) return {};
  return {0, plan_.practice->object, plan_.practice->method};
}

std::size_t StudySession::next_open() const {
  const auto open = std::find(progress_.trials.begin(), progress_.trials.end(), Fate::open);
  return static_cast<std::size_t>(open - progress_.trials.begin());
}

std::size_t StudySession::order_now() const {
  if (practising()) return 0;
  const auto begin = progress_.trials.begin();
  const auto here = begin + static_cast<std::ptrdiff_t>(trial_);
  return 1 + static_cast<std::size_t>(std::count(begin, here, Fate::finished));
}

void StudySession::enter(StudyState state, std::int64_t now_ns) {
  state_ = state;
  since_ns_ = now_ns;
  last_view_ns_ = now_ns;
  set_scene();
  build_view();
}

void StudySession::to_next(std::int64_t now_ns) {
  if (plan_.practice && !progress_.practised) return ready(kPractice, now_ns);
  const std::size_t next = next_open();
  if (next < trials_.size()) return ready(next, now_ns);
  trial_ = trials_.empty() ? kPractice : trials_.size() - 1;
  if (begun_) note(What::completed, now_ns);
  enter(StudyState::thanks, now_ns);
}

void StudySession::ready(std::size_t trial, std::int64_t now_ns) {
  trial_ = trial;
  enter(StudyState::ready, now_ns);
}

void StudySession::begin_trial(std::int64_t now_ns) {
  given_.assign(plan_.questions.size(), Given{});
  if (practising()) {
    ++practices_;
    note(What::practice, now_ns);
  } else {
    ++progress_.attempts[trial_];
    note(What::trial, now_ns);
  }
  enter(StudyState::countdown, now_ns);
  advance(now_ns);  // there may be none
}

void StudySession::begin_stroking(std::int64_t now_ns) {
  note(What::stroking, now_ns);
  enter(StudyState::stroking, now_ns);
}

void StudySession::end_stroking(std::int64_t now_ns) {
  note(What::stroked, now_ns);
  ask(0, now_ns);
}

void StudySession::break_off(std::int64_t now_ns) {
  if (state_ != StudyState::countdown && state_ != StudyState::stroking) return;
  note(What::broken_off, now_ns);
}

void StudySession::ask(std::size_t question, std::int64_t now_ns) {
  question_ = question;
  enter(StudyState::question, now_ns);
}

void StudySession::leave_question(std::int64_t now_ns) {
  given_[question_].shown_ns += now_ns - since_ns_;
}

void StudySession::press_in_question(int button, std::int64_t now_ns) {
  if (button == kConfirmButton) return confirm(now_ns);
  if (button == kBackButton) {
    leave_question(now_ns);
    return ask(question_ - 1, now_ns);
  }
  given_[question_].choice = button - kAnswerButton;
  build_view();
}

void StudySession::confirm(std::int64_t now_ns) {
  leave_question(now_ns);
  Given& given = given_[question_];
  if (given.choice != given.kept && !practising()) {
    note(What::answered, now_ns);
    StudyEvent& event = events_.back();
    event.question = question_;
    event.answer = given.choice;
    event.response_ns = given.shown_ns;
    event.changed = given.kept != 0;
  }
  given.kept = given.choice;
  if (question_ + 1 < plan_.questions.size()) return ask(question_ + 1, now_ns);
  finish_trial(now_ns);
}

void StudySession::finish_trial(std::int64_t now_ns) {
  if (practising()) {
    progress_.practised = true;
    return to_next(now_ns);
  }
  note(What::finished, now_ns);
  progress_.trials[trial_] = Fate::finished;
  last_done_ = trial_;
  ++done_since_rest_;
  after_trial(now_ns);
}

void StudySession::after_trial(std::int64_t now_ns) {
  const bool rests = plan_.rest && done_since_rest_ >= plan_.rest->after_trials;
  if (!rests || next_open() == trials_.size()) return to_next(now_ns);
  done_since_rest_ = 0;
  note(What::rest, now_ns);
  enter(StudyState::rest, now_ns);
}

void StudySession::note(What what, std::int64_t now_ns) {
  StudyEvent event;
  event.what = what;
  event.time_ns = now_ns;
  event.trial = practising() ? 0 : trials_[trial_].number;
  event.attempt = practising() ? practices_ : progress_.attempts[trial_];
  event.order = order_now();
  events_.push_back(std::move(event));
}

void StudySession::set_scene() {
  scene_ = {};
  const Trial trial = current();
  scene_.trial = trial.number;
  scene_.attempt = practising() ? practices_ : progress_.attempts[trial_];
  const bool strokes = state_ == StudyState::countdown || state_ == StudyState::stroking;
  if (!strokes && state_ != StudyState::ready) return;
  const StudyObject* const object = find_object(plan_, trial.object);
  if (object != nullptr) scene_.coming_spec = object->spec;
  if (!strokes) return;
  scene_.object = trial.object;
  scene_.spec = scene_.coming_spec;
  scene_.method = trial.method;
  scene_.recording = state_ == StudyState::stroking && !practising();
}

}  // namespace nade::study
