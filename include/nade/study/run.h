#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "nade/corrector.h"
#include "nade/status.h"
#include "nade/study/session.h"
#include "nade/study/store.h"
#include "nade/surface.h"

namespace nade::study {

struct RunOptions {
  StoreOptions store;
  /// The folder that an object's file is named from; empty: where the program runs.
  std::string plan_folder;
  std::string source = "mouse";  ///< of the hands, for the recordings' headers
  bool hand_scale_known = false;
};

/// What a frame shows, for the recording of it.
struct RunFrame {
  std::int64_t now_ns = 0;  ///< the study's time, of any steady clock
  /// By index_of(Handedness); null where a hand is not tracked. Both are of the same frame.
  std::array<const HandPose*, 2> tracked{};
  std::array<const CorrectedHand*, 2> corrected{};
  std::optional<Pose> head;
  Placement object;  ///< where the object stands, from the start of a trial to its end
  /// For how long the object has been moving, where it moves by itself.
  std::optional<std::int64_t> animated_ns{};
};

/// A participant's study while it runs: its course, its files and the recording of motion. Who
/// draws it calls `frame` once a frame, shows `view` and `scene`, and passes presses on. Whatever
/// has to be on disk is there when a call returns; when something could not be kept the panel says
/// so, the study is over and `status` has the sentence.
///
///     const StudyScene& scene = run.scene();   // load scene.spec, correct by scene.method
///     run.frame({now_ns, {…}, {…}, head, placement});
///     if (run.view_revision() != drawn) …      // draw run.view()
///     if (poked) run.press(button_id, now_ns);
class StudyRun {
 public:
  /// Begins a participant's study or goes on with it; see `StudyStore::open`.
  [[nodiscard]] static Result<std::unique_ptr<StudyRun>> open(const Plan& plan, RunOptions options);
  StudyRun(const StudyRun&) = delete;
  StudyRun& operator=(const StudyRun&) = delete;
  /// Ends what is being written. A study that is not over can be gone on with.
  ~StudyRun();

  /// Lets the study go on, and records the frame where its motion is to be kept. Does not allocate
  /// but where the view changes; files are written where a trial begins or ends.
  void frame(const RunFrame& frame);

  void press(int button, std::int64_t now_ns);
  void pause(std::int64_t now_ns);
  void resume(std::int64_t now_ns);
  void repeat(std::int64_t now_ns);
  void skip(const std::string& reason, std::int64_t now_ns);
  void stop(std::int64_t now_ns);
  /// For a run that could not be shown; see `StudyStore::withdraw`.
  bool withdraw();
  /// Waits until the motion so far is written; for who does not live in real time.
  void drain();

  [[nodiscard]] StudyState state() const;
  [[nodiscard]] bool over() const;
  [[nodiscard]] const PanelView& view() const;
  [[nodiscard]] std::uint64_t view_revision() const;
  [[nodiscard]] const StudyScene& scene() const;
  [[nodiscard]] const StudySession& session() const;
  [[nodiscard]] const StudyStore& store() const;
  /// Frames whose motion the disk was too slow for.
  [[nodiscard]] std::size_t dropped_frames() const;
  /// What could not be kept, if anything.
  [[nodiscard]] const Status& status() const;

 private:
  struct Impl;
  explicit StudyRun(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace nade::study
