#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clip.h"
#include "figures.h"
#include "mouse_hand.h"
#include "nade/corrector.h"
#include "nade/draw/stage.h"
#include "nade/io/object_file.h"

namespace nade::viewer {

/// A method to choose from.
struct MethodChoice {
  Method method;
  const char* name;
  const char* tip;
};
[[nodiscard]] std::span<const MethodChoice> method_choices();

/// Whether corrections are timed; without it a session gives the same figures on every run.
enum class Timing : std::uint8_t { real, none };

/// How a recording is being shown.
struct Playback {
  bool playing = true;
  bool loop = true;
  double speed = 1.0;
  double time_s = 0.0;    ///< since the first frame
  std::size_t index = 0;  ///< of the frame that is shown
};

/// What the viewer works on: an object, and a hand on it from a recording or from the mouse,
/// corrected and measured as it goes.
class Session {
 public:
  struct Setup {
    draw::HandMeshes meshes;
    HandPose relaxed;
    CorrectorOptions corrector;
    Timing timing = Timing::real;
  };
  explicit Session(Setup setup);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Shows another object. Without a placement it stands as it is loaded, under a recording so
  /// that the palms are pressed into it. After an error everything is as before.
  [[nodiscard]] Status show_object(const std::string& spec,
                                   const std::optional<Placement>& placement = {});
  /// Changes to another recording, with the object it was made on where it names one, once it is
  /// read. After an error everything is as before, also after one that only reading shows and that
  /// is a notice then.
  [[nodiscard]] Status open_clip(const std::string& path);
  /// Whether the object that is shown stays also where the next recording names one of its own.
  enum class Keep : std::uint8_t { no, yes };
  void keep_object(Keep keep) { keep_ = keep; }
  /// Takes what was dropped: a recording or a mesh, as its content says.
  [[nodiscard]] Status open_any(const std::string& path);
  /// Back to the hand of the mouse.
  void close_clip();
  void set_corrector(const CorrectorOptions& options);
  void set_settle(const SettleOptions& settle);
  [[nodiscard]] const CorrectorOptions& corrector() const { return setup_.corrector; }

  /// Moves the object so that the recorded palms lie so deep, as `nade correct --press`.
  [[nodiscard]] Status press(double depth_m);
  /// As asked for last; no value where the object stands as it was placed.
  [[nodiscard]] const std::optional<double>& press_m() const { return press_m_; }

  void seek(std::size_t index);
  void step(int frames);
  /// From the end it plays from the start.
  void play_or_pause();
  [[nodiscard]] Playback& playback() { return playback_; }
  /// The recording that is shown; null where the mouse moves the hand.
  [[nodiscard]] const Clip* clip() const { return clip_ ? &*clip_ : nullptr; }
  /// How many recordings have been shown so far.
  [[nodiscard]] std::size_t clips_begun() const { return clips_begun_; }
  /// Whether the recording is still being read.
  [[nodiscard]] bool loading() const { return clip_ && !clip_begun_; }

  /// Goes on by `step_s` seconds (> 0).
  void advance(double step_s, const Aim& aim);

  [[nodiscard]] const draw::StagedHands& hands() const { return hands_; }
  /// The same as the corrector gave them, by index_of(Handedness); null where there is none.
  [[nodiscard]] const CorrectedHand* corrected(std::size_t side) const {
    return hands_[side] ? corrected_[side] : nullptr;
  }
  [[nodiscard]] const LoadedObject& loaded() const { return *loaded_; }
  [[nodiscard]] bool has_object() const { return loaded_ != nullptr; }
  [[nodiscard]] std::shared_ptr<const LoadedObject> shared_object() const { return loaded_; }
  /// Of the object as it is drawn: as set for the method nade, of hands corrected already as they
  /// were recorded.
  [[nodiscard]] double softness_m() const;
  /// By which the drawn hands are corrected, or were when they were recorded.
  [[nodiscard]] Method drawn_method() const;
  [[nodiscard]] const Placement& placement() const { return placement_; }
  [[nodiscard]] Object object() const { return loaded_->placed(placement_); }
  /// For how long the mouse has moved the hand, which is how far on the object's animation is then.
  [[nodiscard]] std::int64_t mouse_time_ns() const { return mouse_time_ns_; }
  [[nodiscard]] MouseHand& mouse_hand() { return mouse_hand_; }
  [[nodiscard]] Figures& figures() { return figures_; }
  [[nodiscard]] const draw::HandMeshes& meshes() const { return setup_.meshes; }

  /// Sentences for the person that have come up since the last call.
  [[nodiscard]] std::vector<std::string> take_notices();

 private:
  void begin_clip();
  void advance_clip(double step_s);
  enum class Measured : std::uint8_t { no, yes };
  void show_frame(std::size_t index, Measured measured);
  void correct(const HandPose& tracked, std::int64_t time_ns, Measured measured);
  [[nodiscard]] Status stand_under_clip();
  [[nodiscard]] Status stand_as_recorded();
  [[nodiscard]] double animation_time_s(std::int64_t clip_time_ns) const;
  void restart();
  void return_to_method();
  void put_mouse_hand();

  Setup setup_;
  std::optional<Method> method_before_;  ///< chosen, where a corrected recording has set it aside
  std::shared_ptr<LoadedObject> loaded_;
  Placement placement_;
  Keep keep_ = Keep::no;
  bool placed_by_hand_ = false;  ///< the placement was asked for
  std::optional<double> press_m_;
  std::optional<Clip> clip_;
  bool clip_begun_ = false;
  std::optional<ObjectPlacing> recorded_;  ///< as the recording's header says
  double recorded_softness_m_ = 0.0;
  Method recorded_method_ = Method::none;  ///< by which a clip was corrected
  std::size_t clips_begun_ = 0;
  std::optional<Clip> clip_before_;  ///< until the new one is known to be whole
  Playback playback_;
  MouseHand mouse_hand_;
  std::int64_t mouse_time_ns_ = 0;
  std::array<HandCorrector, 2> correctors_;
  std::array<std::optional<double>, 2> scales_{};
  draw::StagedHands hands_{};
  std::array<const CorrectedHand*, 2> corrected_{};  ///< the correctors' own
  Figures figures_;
  std::vector<std::string> notices_;
};

}  // namespace nade::viewer
