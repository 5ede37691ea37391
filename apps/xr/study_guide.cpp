#include "study_guide.h"

#include <algorithm>
#include <utility>

namespace nade::xr {
namespace {

/// A trial in which the headset showed nothing for so long is begun again.
constexpr std::int64_t kGap_ns = 1'000'000'000;
/// For so long the last words are to be read.
constexpr std::int64_t kFarewell_ns = 5'000'000'000;
constexpr double kStep_m = 0.02;

}  // namespace

StudyGuide::StudyGuide(study::StudyRun& run, double speed) : run_(run), speed_(speed) {
  take_view();
}

std::vector<std::string> StudyGuide::objects() const {
  std::vector<std::string> specs;
  for (const study::StudyObject& object : run_.session().plan().objects) {
    specs.push_back(object.spec);
  }
  return specs;
}

void StudyGuide::take_view() {
  const study::StudyScene& scene = run_.scene();
  revision_ = run_.view_revision();
  show_.object = scene.spec;
  show_.method = scene.method;
  show_.shown = draw::Shown::corrected;
  show_.panel = run_.view();
  show_.panel_before_person = scene.spec.empty();
  changed_ = true;
}

bool StudyGuide::changed() { return std::exchange(changed_, false); }

std::int64_t StudyGuide::study_time(std::int64_t time_ns) {
  if (!first_ns_) first_ns_ = time_ns;
  return static_cast<std::int64_t>(speed_ * static_cast<double>(time_ns - *first_ns_));
}

void StudyGuide::press(int button) { run_.press(button, now_ns_); }

void StudyGuide::seen(const Moment& moment) {
  const study::MotionFrame& motion = moment.motion;
  now_ns_ = study_time(motion.time_ns);
  if (last_ns_ != 0 && motion.time_ns - last_ns_ > kGap_ns &&
      run_.state() != study::StudyState::paused) {
    run_.pause(now_ns_);
    run_.resume(now_ns_);
  }
  last_ns_ = motion.time_ns;
  study::RunFrame frame;
  frame.now_ns = now_ns_;
  for (std::size_t side = 0; side < 2; ++side) {
    if (motion.tracked[side]) frame.tracked[side] = &*motion.tracked[side];
    if (motion.corrected[side]) frame.corrected[side] = &*motion.corrected[side];
  }
  frame.head = motion.head;
  frame.object = moment.object;
  frame.animated_ns = moment.animated_ns;
  run_.frame(frame);
  if (run_.view_revision() != revision_ || run_.scene().spec != show_.object ||
      run_.scene().method != show_.method) {
    take_view();
  }
  if (!run_.over()) return;
  if (!over_ns_) over_ns_ = motion.time_ns;
  wishes_.leave =
      speed_ * static_cast<double>(motion.time_ns - *over_ns_) > static_cast<double>(kFarewell_ns);
}

bool StudyGuide::obey(const std::string& word) {
  constexpr std::string_view kSkip = "skip ";
  if (word == "pause") {
    run_.pause(now_ns_);
  } else if (word == "resume") {
    run_.resume(now_ns_);
  } else if (word == "repeat") {
    run_.repeat(now_ns_);
  } else if (word.starts_with(kSkip) && word.size() > kSkip.size()) {
    run_.skip(word.substr(kSkip.size()), now_ns_);
  } else if (word == "stop") {
    run_.stop(now_ns_);
  } else if (word == "recentre") {
    wishes_.recentre = true;
  } else if (word == "higher" || word == "lower") {
    wishes_.raise_m += word == "higher" ? kStep_m : -kStep_m;
  } else {
    return false;
  }
  return true;
}

Guide::Wishes StudyGuide::take_wishes() { return std::exchange(wishes_, {}); }

}  // namespace nade::xr
