#include <fmt/format.h>

#include <cmath>

#include "nade/study/session.h"

namespace nade::study {
namespace {

/// The panel's own words; a plan has the rest.
struct Words {
  Text welcome{"Welcome", "ようこそ"};
  Text start{"Start", "始める"};
  Text go_on{"Go on", "続ける"};
  Text confirm{"Confirm", "決定"};
  Text back{"Back", "戻る"};
  Text practice{"Practice", "練習"};
  Text practise_again{"Practise again", "もう一度練習する"};
  Text trial{"Trial {} of {}", "試行 {} / {}"};
  Text question{"Question {} of {}", "質問 {} / {}"};
  Text ready{
      "When you are ready, press Start. The object appears; hold your hand over it, and stroke it "
      "as soon as the count-down is over.",
      "準備ができたら「始める」を押してください。物体が現れますので、その上に手をかざし、カウントダ"
      "ウンが終わったら撫でてください。"};
  Text practice_ready{
      "First some practice. It is as the real trials are; your answers are not kept.",
      "まず練習をします。本番と同じ流れですが、回答は記録されません。"};
  Text soon{"Hold your hand over the object.", "物体の上に手をかざしてください。"};
  Text stroke{"Stroke the object.", "物体を撫でてください。"};
  Text seconds{"{} s", "{} 秒"};
  Text rest{"Rest", "休憩"};
  Text resting{"Take a rest. Go on when you like, after {} s at the earliest.",
               "休憩してください。あと {} 秒で続けられます。"};
  Text rested{"Go on when you like.", "準備ができたら続けてください。"};
  Text pause{"Pause", "一時停止"};
  Text pausing{"Please wait a moment. The experimenter goes on.",
               "少しお待ちください。実験者が再開します。"};
  Text thanks{"Thank you", "ありがとうございました"};
  Text stopped{"Stopped", "中止"};
  Text stopping{"The study was stopped here. It can go on another time.",
                "ここで中止しました。後で再開できます。"};
  Text failed{"Please call the experimenter", "実験者を呼んでください"};
};

const Words kWords;

template <class... Numbers>
std::string filled(const Text& text, Language language, Numbers... numbers) {
  return fmt::format(fmt::runtime(text.in(language)), numbers...);
}

PanelButton button(int id, const Text& label, Language language) {
  return {id, label.in(language)};
}

}  // namespace

void StudySession::build_view() {
  const Language language = plan_.language;
  const auto word = [&](const Text& text) { return text.in(language); };
  view_ = {};
  ++revision_;
  shown_seconds_ = static_cast<int>(std::ceil(remaining_s()));
  const std::string trial =
      practising() ? word(kWords.practice)
                   : filled(kWords.trial, language, trials_[trial_].number, trials_.size());
  switch (state_) {
    case StudyState::instructions:
      // Not the plan's title, which may tell what is tested.
      view_.heading = word(kWords.welcome);
      for (const Text& paragraph : plan_.instructions) view_.lines.push_back(word(paragraph));
      view_.rows = {{button(kContinueButton, kWords.go_on, language)}};
      break;
    case StudyState::ready:
      view_.heading = trial;
      if (practising()) view_.lines.push_back(word(kWords.practice_ready));
      view_.lines.push_back(word(kWords.ready));
      view_.rows = {{button(kStartButton, kWords.start, language)}};
      if (practices_ > 0 && trial_ == 0 && progress_.attempts[0] == 0) {
        view_.rows.push_back({button(kPractiseAgainButton, kWords.practise_again, language)});
      }
      break;
    case StudyState::countdown:
    case StudyState::stroking: {
      const bool strokes = state_ == StudyState::stroking;
      view_.heading = filled(kWords.seconds, language, shown_seconds_);
      view_.lines = {trial, word(strokes ? kWords.stroke : kWords.soon)};
      break;
    }
    case StudyState::question:
      show_question(trial);
      break;
    case StudyState::rest:
      view_.heading = word(kWords.rest);
      view_.lines = {shown_seconds_ > 0 ? filled(kWords.resting, language, shown_seconds_)
                                        : word(kWords.rested)};
      view_.rows = {{button(kContinueButton, kWords.go_on, language)}};
      view_.rows[0][0].enabled = shown_seconds_ == 0;
      break;
    case StudyState::paused:
      view_.heading = word(kWords.pause);
      view_.lines = {word(kWords.pausing)};
      break;
    case StudyState::thanks:
      view_.heading = word(kWords.thanks);
      view_.lines = {word(plan_.thanks)};
      break;
    case StudyState::stopped:
      view_.heading = word(kWords.stopped);
      view_.lines = {word(kWords.stopping)};
      break;
    case StudyState::failed:
      view_.heading = word(kWords.failed);
      view_.lines = {failure_};
      break;
  }
}

void StudySession::show_question(const std::string& trial) {
  const Language language = plan_.language;
  const Given& given = given_[question_];
  view_.heading = fmt::format(
      "{} · {}", trial, filled(kWords.question, language, question_ + 1, plan_.questions.size()));
  view_.lines = {plan_.questions[question_].text.in(language),
                 fmt::format("1: {}   {}: {}", plan_.scale.low.in(language), plan_.scale.points,
                             plan_.scale.high.in(language))};
  view_.rows.resize(2);
  for (int answer = 1; answer <= plan_.scale.points; ++answer) {
    view_.rows[0].push_back(
        {kAnswerButton + answer, std::to_string(answer), given.choice == answer});
  }
  view_.rows[1] = {button(kBackButton, kWords.back, language),
                   button(kConfirmButton, kWords.confirm, language)};
  view_.rows[1][0].enabled = question_ > 0;
  view_.rows[1][1].enabled = given.choice != 0;
}

}  // namespace nade::study
