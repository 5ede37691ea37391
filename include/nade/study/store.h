#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "nade/status.h"
#include "nade/study/participant.h"
#include "nade/study/session.h"

namespace nade::study {

struct StoreOptions {
  std::string folder;         ///< of the study; made where it is not there
  std::string participant;    ///< letters, digits, - and _
  std::string tool = "nade";  ///< with its version
  Origin origin = Origin::person;
  Motion motion = Motion::recorded;
  double speed = 1.0;  ///< of the study's time against life's
  /// The time of day, ISO 8601 UTC; the system's where it is empty.
  std::function<std::string()> wall_clock;
  /// Whether each answer is forced onto the disk; without, a power cut may lose some.
  enum class Safety : std::uint8_t { synced, quick };
  Safety safety = Safety::synced;
};

/// The files of one participant. Answers and events are only ever added, a whole line at a time,
/// and are on disk when `keep` returns. One program at a time may have a folder open.
class StudyStore {
 public:
  /// Makes the participant's folder, or goes on with it: then the plan has to be the same, a line
  /// that was cut off is cut away, and what is damaged otherwise is an error that names file and
  /// line; so is a file that is missing beside others. A participant's id with other characters is
  /// `ErrorCode::out_of_range`.
  [[nodiscard]] static Result<StudyStore> open(const Plan& plan, StoreOptions options);
  StudyStore(StudyStore&&) noexcept;
  StudyStore& operator=(StudyStore&&) noexcept;
  ~StudyStore();

  [[nodiscard]] const std::vector<Trial>& trials() const;
  [[nodiscard]] const StudyProgress& progress() const;  ///< when it was opened
  /// What was done about files that were not whole, a sentence each.
  [[nodiscard]] const std::vector<std::string>& notes() const;
  /// "DIR/P01"
  [[nodiscard]] const std::string& folder() const;
  [[nodiscard]] const StoreOptions& options() const;

  /// Keeps an event. After an error nothing more is kept.
  [[nodiscard]] Status keep(const StudyEvent& event);
  /// Keeps a remark ("dropped_frames") in the log.
  [[nodiscard]] Status remark(const std::string& event, const std::string& reason);
  /// Takes a participant back who was new when this was opened and of whom no event was kept: the
  /// files and the folders made for them are gone. Otherwise does nothing and gives false.
  bool withdraw();
  /// The time of day, by the options.
  [[nodiscard]] std::string now() const;

 private:
  struct Impl;
  explicit StudyStore(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace nade::study
