// A person for Monado's remote driver:
//   remote_hands stroke           strokes a ball whose top is before them, hand sunk into it; the
//                                 trackers lose the hand from time to time
//   remote_hands steady           the same, and the hand is never lost
//   remote_hands answer PANEL     presses what a panel asks for, strokes in between
//   remote_hands press PANEL ID…  presses these buttons, one after another, then strokes
// PANEL is what `--panel-log` writes. Goes on until it is ended, or the service goes.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "nade/study/session.h"
#include "remote_hands.h"

namespace nade::test {
namespace {

constexpr double kStep_s = 0.01;
/// The ball that `nade xr` puts before a person like ours.
const Vec3 kBallTop(0.0, 1.18, -0.40);
constexpr double kBallRadius_m = 0.15;
/// From the palm's joint to the skin, about, and how deep that sinks in.
constexpr double kPalmSkin_m = 0.016;
constexpr double kSunk_m = 0.012;
constexpr double kStrokePeriod_s = 3.0;
/// The hand is lost from time to time, as trackers do.
constexpr double kLostEvery_s = 7.0;
constexpr double kLostFor_s = 0.4;
constexpr double kPoke_s = 0.9;
constexpr double kPatience_s = 1.0;

struct Button {
  int id = 0;
  bool chosen = false;
  Vec3 at = Vec3::Zero();
};

struct Panel {
  std::string line;
  Quat turn = Quat::Identity();
  std::vector<Button> buttons;  ///< those that can be pressed
};

/// The last whole line of the log.
std::optional<Panel> read_panel(const std::string& path) {
  std::ifstream file(path);
  Panel panel;
  std::string line;
  while (std::getline(file, line)) {
    if (!file.eof()) panel.line = line;
  }
  const auto json = nlohmann::json::parse(panel.line, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  const auto& q = json.at("turn");
  panel.turn = Quat(q[3].get<double>(), q[0].get<double>(), q[1].get<double>(), q[2].get<double>());
  for (const auto& each : json.at("buttons")) {
    if (!each.at("enabled").get<bool>()) continue;
    const auto& at = each.at("at");
    panel.buttons.push_back({each.at("id").get<int>(), each.at("chosen").get<bool>(),
                             Vec3(at[0].get<double>(), at[1].get<double>(), at[2].get<double>())});
  }
  return panel;
}

class Person {
 public:
  /// Whether the trackers lose the hand from time to time.
  enum class Tracking : std::uint8_t { whole, with_gaps };
  Person(RemoteDriver driver, Tracking tracking)
      : driver_(std::move(driver)), loses_(tracking == Tracking::with_gaps) {}

  /// A moment of stroking.
  bool stroke() {
    const double turns = 2.0 * std::numbers::pi * time_s_ / kStrokePeriod_s;
    const double angle = 0.25 * std::sin(turns);
    // It comes from above at first.
    const double above = std::max(0.0, 0.10 * (1.0 - time_s_ / 1.5));
    const Quat turn(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
    const double from_center = kBallRadius_m + kPalmSkin_m - kSunk_m + above;
    const Vec3 center = kBallTop - kBallRadius_m * Vec3::UnitY();
    RemoteHand& hand = state_.hands[index_of(Handedness::right)];
    hand.tracked = !loses_ || std::fmod(time_s_, kLostEvery_s) < kLostEvery_s - kLostFor_s;
    hand.grip =
        grip_for_palm(Handedness::right, {center + turn * Vec3(0.0, from_center, 0.0), turn});
    hand.curl.fill(0.12F);
    return pass();
  }

  /// Puts the index finger through a point of a panel and out again.
  bool poke(const Vec3& at, const Quat& turn) {
    for (double t = 0.0; t < kPoke_s; t += kStep_s) {
      const double before = 0.03 + 0.06 * std::cos(2.0 * std::numbers::pi * t / kPoke_s);
      const Vec3 tip = at + turn * Vec3(0.0, 0.0, before);
      state_.hands[index_of(Handedness::right)] = pointing(Handedness::right, tip, turn);
      if (!pass()) return false;
    }
    return true;
  }

 private:
  bool pass() {
    time_s_ += kStep_s;
    const auto due = start_ + std::chrono::duration<double>(time_s_);
    const auto now = Clock::now();
    // Who waited for a panel does not hurry afterwards.
    if (now > due) start_ += std::chrono::duration_cast<Clock::duration>(now - due);
    std::this_thread::sleep_until(due);
    return driver_.send(state_);
  }

  using Clock = std::chrono::steady_clock;

  RemoteDriver driver_;
  bool loses_;
  RemoteState state_ = looking_down();
  double time_s_ = 0.0;
  Clock::time_point start_ = Clock::now();
};

/// What somebody who answers presses next: an answer, then what leads on.
std::optional<Button> next_answer(const Panel& panel) {
  std::vector<Button> answers;
  bool answered = false;
  for (const Button& button : panel.buttons) {
    if (button.id < study::kAnswerButton) continue;
    answers.push_back(button);
    answered = answered || button.chosen;
  }
  if (!answers.empty() && !answered) {
    return answers[std::hash<std::string>{}(panel.line) % answers.size()];
  }
  for (const int id : {study::kConfirmButton, study::kContinueButton, study::kStartButton}) {
    for (const Button& button : panel.buttons) {
      if (button.id == id) return button;
    }
  }
  return std::nullopt;
}

bool work_panel(Person& person, const std::string& path, std::vector<int>& ids, bool answers) {
  const std::optional<Panel> panel = read_panel(path);
  std::optional<Button> wanted;
  if (panel && answers) wanted = next_answer(*panel);
  if (panel && !answers && !ids.empty()) {
    for (const Button& button : panel->buttons) {
      if (button.id == ids.front()) wanted = button;
    }
  }
  if (!wanted) return person.stroke();
  if (!person.poke(wanted->at, panel->turn)) return false;
  // Until what was pressed shows; if it does not, it is pressed again.
  for (double t = 0.0; t < kPatience_s; t += 0.1) {
    const std::optional<Panel> now = read_panel(path);
    if (now && now->line != panel->line) {
      if (!answers) ids.erase(ids.begin());
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return true;
}

int run(const std::vector<std::string>& words) {
  Result<RemoteDriver> driver = RemoteDriver::connect(4242);
  if (!driver) {
    std::fprintf(stderr, "remote_hands: %s\n", driver.error().message.c_str());
    return 1;
  }
  const bool loses = words.front() == "stroke";
  const bool strokes = loses || words.front() == "steady";
  Person person(std::move(driver).value(),
                loses ? Person::Tracking::with_gaps : Person::Tracking::whole);
  std::vector<int> ids;
  for (std::size_t i = 2; i < words.size(); ++i) ids.push_back(std::atoi(words[i].c_str()));
  while (true) {
    const bool goes_on =
        strokes ? person.stroke() : work_panel(person, words.at(1), ids, words.front() == "answer");
    if (!goes_on) return 0;
  }
}

}  // namespace
}  // namespace nade::test

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "remote_hands stroke | steady | answer PANEL | press PANEL ID...\n");
    return 2;
  }
  return nade::test::run({argv + 1, argv + argc});
}
