#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "nade/study/panel.h"
#include "nade/study/plan.h"

namespace nade::study {

enum class StudyState : std::uint8_t {
  instructions,
  ready,      ///< before a trial: the participant starts it
  countdown,  ///< the object is there, what happens is not recorded yet
  stroking,
  question,
  rest,
  paused,
  thanks,   ///< every trial is done
  stopped,  ///< by the operator, to be resumed another time
  failed,   ///< something could not be kept; the panel says what
};

/// What the participant is to see beside the panel.
struct StudyScene {
  std::string object;  ///< by its name in the plan; empty: none is shown
  std::string spec;    ///< the same as `load_object` takes it
  /// Of the trial that is coming or goes on: to be loaded in time. Empty where none is.
  std::string coming_spec;
  /// How the hands are corrected that are drawn; `none` while no object is shown.
  Method method = Method::none;
  bool recording = false;   ///< whether motion is kept
  std::size_t trial = 0;    ///< its number; 0 is the practice
  std::size_t attempt = 0;  ///< of the trial, from 1
};

/// Something that has to be kept.
struct StudyEvent {
  enum class What : std::uint8_t {
    practice,  ///< begins
    trial,     ///< an attempt at one begins
    stroking,  ///< has begun
    stroked,   ///< to the end
    broken_off,
    answered,
    finished,  ///< every question of the trial is answered
    skipped,
    repeated,  ///< a trial that was finished is to be done again
    rest,
    paused,
    resumed,
    stopped,
    completed,  ///< every trial is done
  };
  What what = What::trial;
  std::int64_t time_ns = 0;
  std::size_t trial = 0;
  std::size_t attempt = 0;
  std::size_t order = 0;  ///< the how-manieth trial that was done, of those not skipped
  // Of an answer:
  std::size_t question = 0;  ///< index in the plan
  int answer = 0;
  std::int64_t response_ns = 0;  ///< for how long the question was shown, without pauses
  bool changed = false;          ///< it takes the place of an earlier one
  std::string reason;            ///< of a skipped trial
};

/// How far a participant is.
struct StudyProgress {
  enum class Fate : std::uint8_t { open, finished, skipped };
  std::vector<Fate> trials;           ///< in the participant's order
  std::vector<std::size_t> attempts;  ///< begun so far at each
  bool practised = false;
};

/// The course of one participant's study: what is shown, which presses do what, when trials begin
/// and end. Has no clock and no files: the caller says what time it is, draws `view` and keeps
/// `events`. Times are nanoseconds of any steady clock; one that goes back counts as standing
/// still.
class StudySession {
 public:
  /// `progress` is empty, or has an entry for each of `trials`.
  StudySession(Plan plan, std::vector<Trial> trials, StudyProgress progress = {});

  /// Lets time go on: count-downs, ends of trials. Allocates only when the view changes.
  void advance(std::int64_t now_ns);
  /// The participant presses a button. One that the view does not have or does not enable, and any
  /// in the first moments of a view, does nothing.
  void press(int button, std::int64_t now_ns);

  /// What the operator may do at any time before the end. A trial that is paused while it is being
  /// stroked is begun again.
  void pause(std::int64_t now_ns);
  void resume(std::int64_t now_ns);
  /// Does the trial again: the one that goes on, or before a trial the last one.
  void repeat(std::int64_t now_ns);
  /// Leaves out what goes on: the instructions, the practice, the trial, the rest.
  void skip(const std::string& reason, std::int64_t now_ns);
  void stop(std::int64_t now_ns);
  /// Ends it because something could not be kept. `sentence` is shown.
  void fail(const std::string& sentence);

  [[nodiscard]] StudyState state() const { return state_; }
  /// Whether it is over: thanks, stopped or failed.
  [[nodiscard]] bool over() const;
  [[nodiscard]] const PanelView& view() const { return view_; }
  /// Grows whenever `view` changes.
  [[nodiscard]] std::uint64_t view_revision() const { return revision_; }
  [[nodiscard]] const StudyScene& scene() const { return scene_; }
  /// Seconds that remain of a count-down, of stroking or of a rest; 0 else.
  [[nodiscard]] double remaining_s() const;
  [[nodiscard]] const Plan& plan() const { return plan_; }
  [[nodiscard]] const std::vector<Trial>& trials() const { return trials_; }
  [[nodiscard]] const StudyProgress& progress() const { return progress_; }

  /// What has happened since `clear_events`.
  [[nodiscard]] std::span<const StudyEvent> events() const { return events_; }
  void clear_events() { events_.clear(); }

 private:
  struct Given {
    int choice = 0;  ///< 0: none
    int kept = 0;    ///< the answer that an event has carried
    std::int64_t shown_ns = 0;
  };

  void enter(StudyState state, std::int64_t now_ns);
  void to_next(std::int64_t now_ns);
  void ready(std::size_t trial, std::int64_t now_ns);
  void begin_trial(std::int64_t now_ns);
  void begin_stroking(std::int64_t now_ns);
  void end_stroking(std::int64_t now_ns);
  void break_off(std::int64_t now_ns);
  void ask(std::size_t question, std::int64_t now_ns);
  void leave_question(std::int64_t now_ns);
  void press_in_question(int button, std::int64_t now_ns);
  void confirm(std::int64_t now_ns);
  void finish_trial(std::int64_t now_ns);
  void after_trial(std::int64_t now_ns);
  void note(StudyEvent::What what, std::int64_t now_ns);
  void set_scene();
  void build_view();
  void show_question(const std::string& trial);
  [[nodiscard]] bool practising() const { return trial_ == kPractice; }
  [[nodiscard]] Trial current() const;
  [[nodiscard]] double trial_s() const;
  [[nodiscard]] double length_s() const;
  [[nodiscard]] std::size_t next_open() const;
  [[nodiscard]] std::size_t order_now() const;

  static constexpr std::size_t kPractice = static_cast<std::size_t>(-1);

  Plan plan_;
  std::vector<Trial> trials_;
  StudyProgress progress_;
  StudyState state_ = StudyState::instructions;
  StudyState before_pause_ = StudyState::instructions;
  std::size_t trial_ = kPractice;  ///< index
  std::optional<std::size_t> last_done_;
  std::size_t done_since_rest_ = 0;
  std::size_t practices_ = 0;
  std::size_t question_ = 0;
  std::vector<Given> given_;
  std::int64_t now_ns_ = 0;
  std::int64_t since_ns_ = 0;      ///< of the state
  std::int64_t last_view_ns_ = 0;  ///< when the view was last another one
  bool begun_ = false;
  int shown_seconds_ = 0;
  std::string failure_;
  PanelView view_;
  std::uint64_t revision_ = 0;
  StudyScene scene_;
  std::vector<StudyEvent> events_;
};

/// Buttons by their ids; an answer's is `kAnswerButton` plus the answer.
inline constexpr int kStartButton = 1;
inline constexpr int kConfirmButton = 2;
inline constexpr int kBackButton = 3;
inline constexpr int kContinueButton = 4;
inline constexpr int kPractiseAgainButton = 5;
inline constexpr int kAnswerButton = 100;

}  // namespace nade::study
