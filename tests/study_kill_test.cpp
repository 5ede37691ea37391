// A study that is killed at any moment has lost no answer and at most a second of motion.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <random>
#include <thread>
#include <vector>

#include "support/recording_files.h"
#include "support/study_files.h"

namespace nade::study {
namespace {

using test::kSecond_ns;
using test::Stroker;

constexpr int kKills = 10;  // or as many as NADE_STUDY_KILLS says
constexpr double kSpeed = 4.0;
constexpr std::int64_t kFrame_ns = kSecond_ns / 30;

/// What the study says of itself through a pipe, after it has moved on.
struct Report {
  enum class What : std::uint8_t { answer, motion, over };
  What what = What::over;
  std::size_t trial = 0;
  std::size_t attempt = 0;
  std::size_t question = 0;
  int answer = 0;
  std::int64_t time_ns = 0;  ///< of motion, since stroking began
};

void say(int pipe, const Report& report) {
  if (::write(pipe, &report, sizeof(report)) != sizeof(report)) ::_exit(3);
}

/// The study, until it is over or killed. Strokes at `kSpeed` times life's speed and answers at
/// once.
[[noreturn]] void sit(const Plan& plan, const RunOptions& options, int pipe) {
  Result<std::unique_ptr<StudyRun>> opened = StudyRun::open(plan, options);
  if (!opened) {
    std::fprintf(stderr, "%s\n", opened.error().message.c_str());
    ::_exit(2);
  }
  StudyRun& run = **opened;
  Stroker person(run);
  std::size_t question = 0;
  std::int64_t stroking_ns = 0;
  while (!run.over()) {
    const StudyState before = run.state();
    const StudyScene scene = run.scene();
    if (before == StudyState::question) {
      person.answer = 1 + static_cast<int>((scene.trial + question + scene.attempt) % 7);
      person.go_on();
      say(pipe, {Report::What::answer, scene.trial, scene.attempt, question, person.answer, 0});
      ++question;
      continue;
    }
    question = 0;
    if (before != StudyState::stroking && before != StudyState::countdown) {
      person.go_on();
      continue;
    }
    person.step(kFrame_ns);
    if (run.state() == StudyState::stroking) {
      if (before != StudyState::stroking) stroking_ns = person.now_ns;
      say(pipe, {Report::What::motion, run.scene().trial, run.scene().attempt, 0, 0,
                 person.now_ns - stroking_ns});
    }
    std::this_thread::sleep_for(std::chrono::nanoseconds(
        static_cast<std::int64_t>(static_cast<double>(kFrame_ns) / kSpeed)));
  }
  say(pipe, {});
  ::_exit(run.status().ok() ? 0 : 4);
}

class StudyKill : public test::StudyFiles {
 protected:
  /// Lets the study run for so long and kills it; what it had said until then.
  std::vector<Report> reports_of_killed(const Plan& plan, const RunOptions& run_options,
                                        std::chrono::microseconds after) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      ::close(ends[0]);
      sit(plan, run_options, ends[1]);
    }
    ::close(ends[1]);
    std::this_thread::sleep_for(after);
    ::kill(child, SIGKILL);
    std::vector<Report> reports;
    Report report;
    while (::read(ends[0], &report, sizeof(report)) == sizeof(report)) reports.push_back(report);
    ::close(ends[0]);
    int state = 0;
    ::waitpid(child, &state, 0);
    EXPECT_TRUE(WIFSIGNALED(state) || WEXITSTATUS(state) == 0) << WEXITSTATUS(state);
    return reports;
  }

  void expect_kept(const Participant& kept, const Report& report) const {
    const std::string& id = kept.head.plan.questions[report.question].id;
    const bool found =
        std::any_of(kept.answers.begin(), kept.answers.end(), [&](const KeptAnswer& answer) {
          return answer.trial == report.trial && answer.attempt == report.attempt &&
                 answer.question == id && answer.answer == report.answer;
        });
    EXPECT_TRUE(found) << kept.folder << ": trial " << report.trial << ", attempt "
                       << report.attempt << ", " << id;
  }

  /// How much of the last motion is lost, seconds.
  [[nodiscard]] static double lost_s(const Participant& kept, const Report& report,
                                     const std::string& kind) {
    const Trial& trial = kept.head.trials[report.trial - 1];
    const auto whole = test::read_whole(kept.folder + "/" + recording_stem(trial, report.attempt) +
                                        "." + kind + ".jsonl.gz");
    const std::int64_t last_ns = whole.frames.empty() ? -kFrame_ns : whole.frames.back().time_ns;
    return 1e-9 * static_cast<double>(report.time_ns - last_ns);
  }
};

TEST_F(StudyKill, LosesNoAnswerAndLessThanASecondOfMotion) {
  const char* const asked = std::getenv("NADE_STUDY_KILLS");
  const int kills = asked == nullptr ? kKills : std::atoi(asked);
  Plan plan = quick_plan();
  plan.trial_s = 1.2;
  plan.countdown_s = 0.2;
  std::mt19937 random(20231);
  std::uniform_int_distribution<int> when_us(1'000, 900'000);
  std::map<std::string, std::vector<Report>> answered;
  int participant = 1;
  std::size_t answers = 0;
  std::size_t in_motion = 0;
  double worst_s = 0.0;
  for (int i = 0; i < kills; ++i) {
    const std::string id = "P" + std::to_string(participant);
    const auto reports =
        reports_of_killed(plan, options(id), std::chrono::microseconds(when_us(random)));
    // Killed before anything stood there.
    if (!std::filesystem::exists(path("data/" + id + "/plan.json"))) continue;
    const Result<Participant> kept = read_participant(path("data/" + id));
    ASSERT_TRUE(kept.ok()) << kept.error().message;
    for (const std::string& problem : kept->problems) {
      // A folder that was just begun may lack them.
      EXPECT_TRUE(test::contains(problem, "no such file")) << problem;
    }
    for (const Report& report : reports) {
      if (report.what == Report::What::answer) answered[id].push_back(report);
    }
    for (const Report& report : answered[id]) expect_kept(*kept, report);
    const auto motion = std::find_if(reports.rbegin(), reports.rend(), [](const Report& report) {
      return report.what == Report::What::motion;
    });
    if (motion != reports.rend()) {
      ++in_motion;
      for (const std::string kind : {"tracked", "corrected"}) {
        const double lost = lost_s(*kept, *motion, kind);
        EXPECT_LE(lost, 1.0) << id << ", " << kind;
        worst_s = std::max(worst_s, lost);
      }
    }
    if (!reports.empty() && reports.back().what == Report::What::over) ++participant;
  }
  for (const auto& [id, given] : answered) answers += given.size();
  std::printf(
      "%d kills, %zu of them in or after motion: %zu answers, none lost; at most %.2f s of motion "
      "lost\n",
      kills, in_motion, answers, worst_s);
  EXPECT_GT(in_motion, 0u);
}

}  // namespace
}  // namespace nade::study
