#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "nade/study/line_break.h"
#include "nade/study/session.h"
#include "support/allocation_counter.h"

namespace nade::study {
namespace {

using What = StudyEvent::What;

constexpr std::int64_t kSecond = 1'000'000'000;

Plan short_plan() {
  Plan plan = default_plan();
  plan.trial_s = 5.0;
  plan.countdown_s = 2.0;
  plan.practice->duration_s = 4.0;
  plan.rest = Rest{2, 10.0};
  return plan;
}

/// A session with a clock that the test moves.
class Sitting {
 public:
  explicit Sitting(const Plan& plan = short_plan(), StudyProgress progress = {})
      : session(plan, trials_of(plan, "P01"), std::move(progress)) {
    session.advance(now_ns);
  }
  void wait(double seconds) {
    now_ns += static_cast<std::int64_t>(seconds * 1e9);
    session.advance(now_ns);
  }
  void press(int button) {
    wait(0.5);
    session.press(button, now_ns);
  }
  /// From "ready" to the first question.
  void stroke() {
    press(kStartButton);
    wait(session.remaining_s());
    wait(session.remaining_s());
  }
  void answer(int value) {
    press(kAnswerButton + value);
    press(kConfirmButton);
  }
  void whole_trial(int value) {
    stroke();
    for (std::size_t i = 0; i < session.plan().questions.size(); ++i) answer(value);
  }
  void to_first_trial() {
    press(kContinueButton);
    whole_trial(4);
    session.clear_events();
  }
  [[nodiscard]] std::vector<What> happened() {
    std::vector<What> what;
    for (const StudyEvent& event : session.events()) what.push_back(event.what);
    session.clear_events();
    return what;
  }
  [[nodiscard]] const PanelButton* button(int id) const {
    for (const auto& row : session.view().rows) {
      for (const PanelButton& button : row) {
        if (button.id == id) return &button;
      }
    }
    return nullptr;
  }

  std::int64_t now_ns = 77 * kSecond;
  StudySession session;
};

TEST(StudySession, RunsFromInstructionsToThanks) {
  Sitting sitting;
  EXPECT_EQ(sitting.session.state(), StudyState::instructions);
  sitting.to_first_trial();
  std::set<std::string> conditions;
  for (int trial = 0; trial < 6; ++trial) {
    ASSERT_EQ(sitting.session.state(), StudyState::ready) << trial;
    sitting.press(kStartButton);
    ASSERT_EQ(sitting.session.state(), StudyState::countdown);
    EXPECT_FALSE(sitting.session.scene().recording);
    EXPECT_FALSE(sitting.session.scene().object.empty());
    sitting.wait(2.0);
    ASSERT_EQ(sitting.session.state(), StudyState::stroking);
    const StudyScene& scene = sitting.session.scene();
    EXPECT_TRUE(scene.recording);
    EXPECT_EQ(scene.trial, static_cast<std::size_t>(trial) + 1);
    conditions.insert(scene.object + std::string(name_of(scene.method)));
    sitting.wait(4.9);
    ASSERT_EQ(sitting.session.state(), StudyState::stroking);
    sitting.wait(0.1);
    for (int answer : {3, 5, 7}) {
      ASSERT_EQ(sitting.session.state(), StudyState::question);
      EXPECT_EQ(sitting.session.scene().object, "");
      EXPECT_EQ(sitting.session.scene().method, Method::none);
      sitting.answer(answer);
    }
    if (sitting.session.state() == StudyState::rest) {
      EXPECT_TRUE(trial == 1 || trial == 3);
      sitting.press(kContinueButton);  // too early
      EXPECT_EQ(sitting.session.state(), StudyState::rest);
      sitting.wait(10.0);
      sitting.press(kContinueButton);
    }
  }
  EXPECT_EQ(sitting.session.state(), StudyState::thanks);
  EXPECT_TRUE(sitting.session.over());
  EXPECT_EQ(conditions.size(), 6u);
}

TEST(StudySession, KeepsEveryAnswerWithItsResponseTime) {
  Sitting sitting;
  sitting.to_first_trial();
  sitting.stroke();
  sitting.session.clear_events();
  sitting.wait(3.0);
  sitting.answer(6);  // two presses, half a second each
  ASSERT_EQ(sitting.session.events().size(), 1u);
  const StudyEvent& event = sitting.session.events()[0];
  EXPECT_EQ(event.what, What::answered);
  EXPECT_EQ(event.trial, 1u);
  EXPECT_EQ(event.attempt, 1u);
  EXPECT_EQ(event.order, 1u);
  EXPECT_EQ(event.question, 0u);
  EXPECT_EQ(event.answer, 6);
  EXPECT_EQ(event.response_ns, 4 * kSecond);
  EXPECT_FALSE(event.changed);
}

TEST(StudySession, PracticeAnswersAreNotKept) {
  Sitting sitting;
  sitting.press(kContinueButton);
  EXPECT_EQ(sitting.session.view().heading, "Practice");
  sitting.stroke();
  EXPECT_EQ(sitting.session.scene().trial, 0u);
  for (int i = 0; i < 3; ++i) sitting.answer(2);
  EXPECT_EQ(sitting.happened(), (std::vector{What::practice, What::stroking, What::stroked}));
  EXPECT_EQ(sitting.session.view().heading, "Trial 1 of 6");
  sitting.press(kPractiseAgainButton);
  EXPECT_EQ(sitting.session.view().heading, "Practice");
}

TEST(StudySession, NothingIsConfirmedWithoutAChoice) {
  Sitting sitting;
  sitting.to_first_trial();
  sitting.stroke();
  sitting.session.clear_events();
  EXPECT_FALSE(sitting.button(kConfirmButton)->enabled);
  EXPECT_FALSE(sitting.button(kBackButton)->enabled);
  sitting.press(kConfirmButton);
  sitting.press(kAnswerButton + 8);
  EXPECT_TRUE(sitting.session.events().empty());
  sitting.press(kAnswerButton + 7);
  sitting.press(kAnswerButton + 2);
  EXPECT_TRUE(sitting.button(kAnswerButton + 2)->chosen);
  EXPECT_FALSE(sitting.button(kAnswerButton + 7)->chosen);
  sitting.press(kConfirmButton);
  EXPECT_EQ(sitting.session.events().back().answer, 2);
}

TEST(StudySession, GoesBackAndChangesAnAnswer) {
  Sitting sitting;
  sitting.to_first_trial();
  sitting.stroke();
  sitting.answer(3);
  sitting.session.clear_events();
  sitting.press(kBackButton);
  EXPECT_TRUE(sitting.button(kAnswerButton + 3)->chosen);
  sitting.press(kConfirmButton);  // the same again: nothing new
  EXPECT_TRUE(sitting.session.events().empty());
  sitting.press(kBackButton);
  sitting.answer(5);
  ASSERT_EQ(sitting.session.events().size(), 1u);
  EXPECT_EQ(sitting.session.events()[0].answer, 5);
  EXPECT_EQ(sitting.session.events()[0].question, 0u);
  EXPECT_TRUE(sitting.session.events()[0].changed);
}

TEST(StudySession, APressMeantForTheViewBeforeDoesNothing) {
  Sitting sitting;
  sitting.to_first_trial();
  sitting.stroke();
  sitting.press(kAnswerButton + 4);
  sitting.press(kConfirmButton);
  const std::uint64_t revision = sitting.session.view_revision();
  sitting.session.press(kAnswerButton + 4, sitting.now_ns + kSecond / 10);
  EXPECT_EQ(sitting.session.view_revision(), revision);
}

TEST(StudySession, PauseWhileStrokingBeginsTheTrialAgain) {
  Sitting sitting;
  sitting.to_first_trial();
  sitting.press(kStartButton);
  sitting.wait(2.0);
  sitting.wait(1.0);
  sitting.session.clear_events();
  sitting.session.pause(sitting.now_ns);
  EXPECT_EQ(sitting.session.state(), StudyState::paused);
  EXPECT_FALSE(sitting.session.scene().recording);
  sitting.wait(100.0);
  sitting.session.resume(sitting.now_ns);
  EXPECT_EQ(sitting.happened(), (std::vector{What::broken_off, What::paused, What::resumed}));
  sitting.stroke();
  ASSERT_EQ(sitting.session.state(), StudyState::question);
  sitting.answer(1);
  EXPECT_EQ(sitting.session.events().back().attempt, 2u);
}

TEST(StudySession, APauseIsNotResponseTime) {
  Sitting sitting;
  sitting.to_first_trial();
  sitting.stroke();
  sitting.wait(1.0);
  sitting.session.pause(sitting.now_ns);
  sitting.wait(60.0);
  sitting.session.resume(sitting.now_ns);
  sitting.answer(4);
  EXPECT_EQ(sitting.session.events().back().response_ns, 2 * kSecond);
}

TEST(StudySession, SkipsWithAReasonAndCountsTheOrderOn) {
  Sitting sitting;
  sitting.to_first_trial();
  sitting.session.skip("sick", sitting.now_ns);
  ASSERT_EQ(sitting.session.events().size(), 1u);
  EXPECT_EQ(sitting.session.events()[0].what, What::skipped);
  EXPECT_EQ(sitting.session.events()[0].trial, 1u);
  EXPECT_EQ(sitting.session.events()[0].reason, "sick");
  sitting.whole_trial(4);
  const StudyEvent& last = sitting.session.events()[4];
  EXPECT_EQ(last.what, What::answered);
  EXPECT_EQ(last.trial, 2u);
  EXPECT_EQ(last.order, 1u);
}

TEST(StudySession, RepeatsWhatGoesOnOrTheLastTrial) {
  Sitting sitting;
  sitting.to_first_trial();
  sitting.session.repeat(sitting.now_ns);  // nothing to repeat yet
  EXPECT_EQ(sitting.session.view().heading, "Trial 1 of 6");
  sitting.whole_trial(4);
  EXPECT_EQ(sitting.session.view().heading, "Trial 2 of 6");
  sitting.session.repeat(sitting.now_ns);
  EXPECT_EQ(sitting.session.view().heading, "Trial 1 of 6");
  sitting.stroke();
  sitting.answer(2);
  EXPECT_EQ(sitting.session.events().back().attempt, 2u);
  EXPECT_FALSE(sitting.session.events().back().changed);
  sitting.session.repeat(sitting.now_ns);
  sitting.whole_trial(3);
  EXPECT_EQ(sitting.session.progress().attempts[0], 3u);
  EXPECT_EQ(sitting.session.view().heading, "Trial 2 of 6");
}

TEST(StudySession, StopsAndGoesOnAtTheFirstOpenTrial) {
  Sitting sitting;
  sitting.to_first_trial();
  sitting.whole_trial(4);
  sitting.stroke();
  sitting.answer(4);
  sitting.session.stop(sitting.now_ns);
  EXPECT_TRUE(sitting.session.over());
  Sitting again(short_plan(), sitting.session.progress());
  EXPECT_EQ(again.session.view().heading, "Trial 2 of 6");
  again.stroke();
  again.answer(4);
  EXPECT_EQ(again.session.events().back().attempt, 2u);
}

TEST(StudySession, ADoneStudyIsThanks) {
  StudyProgress progress;
  progress.trials.assign(6, StudyProgress::Fate::finished);
  progress.attempts.assign(6, 1);
  Sitting sitting(short_plan(), progress);
  EXPECT_EQ(sitting.session.state(), StudyState::thanks);
}

TEST(StudySession, NoPanelShowsTheTitle) {
  Plan plan = short_plan();
  plan.title = "With and without correction";
  for (const Language language : {Language::english, Language::japanese}) {
    plan.language = language;
    const Sitting sitting(plan);
    EXPECT_EQ(sitting.session.view().heading,
              language == Language::english ? "Welcome" : "ようこそ");
  }
}

TEST(LineBreak, EnglishBreaksAtBlanks) {
  const auto letters = [](std::string_view text) { return static_cast<double>(text.size()); };
  EXPECT_EQ(broken_lines("a hand on the dog", 8.0, letters),
            (std::vector<std::string>{"a hand", "on the", "dog"}));
  EXPECT_EQ(broken_lines("stroking", 3.0, letters), (std::vector<std::string>{"str", "oki", "ng"}));
  EXPECT_EQ(broken_lines("one\n\ntwo", 8.0, letters), (std::vector<std::string>{"one", "", "two"}));
  EXPECT_EQ(broken_lines("", 8.0, letters), std::vector<std::string>{""});
}

TEST(LineBreak, JapaneseBreaksBetweenPhrases) {
  const auto bytes = [](std::string_view text) { return static_cast<double>(text.size()) / 3.0; };
  EXPECT_EQ(broken_lines("片手の手のひらと指で、物体の表面をゆっくり撫でてください。", 9.0, bytes),
            (std::vector<std::string>{"片手の手のひらと", "指で、物体の", "表面をゆっくり",
                                      "撫でてください。"}));
  EXPECT_EQ(broken_lines("少し\u200Bお待ちください。", 6.0, bytes),
            (std::vector<std::string>{"少し", "お待ちくださ", "い。"}));
  EXPECT_EQ(broken_lines("準備ができたら「始める」を押す。", 8.0, bytes),
            (std::vector<std::string>{"準備ができたら", "「始める」を", "押す。"}));
}

TEST(LineBreak, ZeroWidthSpacesSayWhereInstead) {
  const auto bytes = [](std::string_view text) { return static_cast<double>(text.size()) / 3.0; };
  EXPECT_EQ(broken_lines("繰り返し\u200B撫でて\u200Bください。", 8.0, bytes),
            (std::vector<std::string>{"繰り返し撫でて", "ください。"}));
  EXPECT_EQ(broken_lines("繰り返し\u200B撫でる。", 4.0, bytes),
            (std::vector<std::string>{"繰り返し", "撫でる。"}));
}

TEST(StudySession, SpeaksBothLanguages) {
  Plan plan = short_plan();
  plan.language = Language::japanese;
  Sitting sitting(plan);
  sitting.press(kContinueButton);
  EXPECT_EQ(sitting.session.view().heading, "練習");
  EXPECT_EQ(sitting.button(kStartButton)->label, "始める");
}

TEST(StudySession, FramesBetweenChangesDoNotAllocate) {
  Sitting sitting;
  sitting.to_first_trial();
  sitting.press(kStartButton);
  sitting.wait(2.0);
  sitting.wait(0.01);
  const std::uint64_t revision = sitting.session.view_revision();
  const std::size_t allocations = test::allocations_of([&] {
    for (int i = 0; i < 50; ++i) {
      sitting.now_ns += kSecond / 90;
      sitting.session.advance(sitting.now_ns);
    }
  });
  EXPECT_EQ(allocations, 0u);
  EXPECT_EQ(sitting.session.view_revision(), revision);
  sitting.wait(1.0);
  EXPECT_GT(sitting.session.view_revision(), revision);
}

TEST(StudySession, TimeThatGoesBackStandsStill) {
  Sitting sitting;
  sitting.to_first_trial();
  sitting.press(kStartButton);
  sitting.session.advance(sitting.now_ns - 1000 * kSecond);
  EXPECT_EQ(sitting.session.state(), StudyState::countdown);
  sitting.wait(2.0);
  EXPECT_EQ(sitting.session.state(), StudyState::stroking);
}

}  // namespace
}  // namespace nade::study
