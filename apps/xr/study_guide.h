#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "guide.h"
#include "nade/study/run.h"

namespace nade::xr {

/// Leads a participant through a study: its run says what is shown. Takes the operator's words.
class StudyGuide final : public Guide {
 public:
  /// `speed`: of the study's time against life's. `run` must outlive it.
  StudyGuide(study::StudyRun& run, double speed);

  [[nodiscard]] const Show& show() override { return show_; }
  [[nodiscard]] bool changed() override;
  void press(int button) override;
  void seen(const Moment& moment) override;
  [[nodiscard]] Wishes take_wishes() override;

  /// What the operator says: pause, resume, repeat, skip REASON, stop, recentre, higher, lower.
  /// False where it is none of these.
  bool obey(const std::string& word);

  /// Every object of the plan, as RoomSetup takes them.
  [[nodiscard]] std::vector<std::string> objects() const;

 private:
  [[nodiscard]] std::int64_t study_time(std::int64_t time_ns);
  void take_view();

  study::StudyRun& run_;
  double speed_;
  Show show_;
  bool changed_ = true;
  std::uint64_t revision_ = 0;
  std::optional<std::int64_t> first_ns_;
  std::int64_t last_ns_ = 0;
  std::int64_t now_ns_ = 0;  ///< the study's
  std::optional<std::int64_t> over_ns_;
  Wishes wishes_;
};

}  // namespace nade::xr
