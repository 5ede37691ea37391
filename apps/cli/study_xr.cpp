#include <fmt/format.h>

#include <utility>

#include "console.h"
#include "headset_run.h"
#include "method_options.h"
#include "operator_words.h"
#include "picture_options.h"
#include "study_guide.h"
#include "study_run.h"

namespace nade::cli {
namespace {

/// The study, and the operator who types beside it.
class AttendedGuide final : public xr::Guide {
 public:
  explicit AttendedGuide(xr::StudyGuide& guide) : guide_(guide) {}

  [[nodiscard]] const xr::Show& show() override { return guide_.show(); }
  [[nodiscard]] bool changed() override { return guide_.changed(); }
  void press(int button) override { guide_.press(button); }
  void seen(const xr::Moment& moment) override {
    guide_.seen(moment);
    const auto word = operator_.next();
    if (word && !guide_.obey(*word)) {
      say("expected pause, resume, repeat, skip REASON, stop, recentre, higher or lower");
    }
  }
  [[nodiscard]] Wishes take_wishes() override { return guide_.take_wishes(); }

 private:
  xr::StudyGuide& guide_;
  xr::OperatorWords operator_;
};

}  // namespace

Status run_study_in_headset(const StudyRunArguments& arguments) {
  Result<draw::HandMeshes> hands = load_hands({});
  if (!hands) return hands.error();
  Result<std::unique_ptr<study::StudyRun>> opened = open_study(arguments, {"openxr", true});
  if (!opened) return opened.error();
  xr::StudyGuide study(**opened, arguments.speed);
  AttendedGuide guide(study);
  MethodOptions method;
  method.corrector.method = Method::nade;
  xr::RoomSetup room;
  room.corrector = options_of(method);
  room.hands = std::move(hands).value();
  room.objects = study.objects();
  xr::HeadsetRun run;
  run.mirror = arguments.mirror;
  run.panel_log = arguments.panel_log;
  const Status shown = xr::run_headset(run, std::move(room), guide);
  return close_study(shown, **opened);
}

}  // namespace nade::cli
