#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bvh_hand.h"
#include "bvh_skeleton.h"
#include "bvh_text.h"
#include "hand_intake.h"
#include "nade/io/recording.h"
#include "warnings.h"

namespace nade::io {

/// Whether a text begins like a BVH file.
[[nodiscard]] bool looks_like_bvh(std::string_view beginning);

/// Reads the hands of a motion capture file (BVH): where its joints are, told by their names, in
/// the unit that the hand's length fits. Rotations are inferred from the points.
class BvhImport {
 public:
  [[nodiscard]] static Result<BvhImport> open(ByteSource source);

  [[nodiscard]] const RecordingHeader& header() const { return header_; }
  [[nodiscard]] Result<std::optional<RecordedFrame>> next();
  [[nodiscard]] const Warnings& warnings() const { return warnings_; }
  [[nodiscard]] HandIntake& intake() { return intake_; }
  [[nodiscard]] const std::string& name() const { return text_.source().name(); }

 private:
  explicit BvhImport(ByteSource source) : text_(std::move(source)) {}

  Status find_hands();
  void guess_unit();
  void tell_guesses();
  Status read_motion();
  /// The numbers of the next frame; false where there is none.
  Result<bool> read_numbers();
  void tell_end();
  void take_hand(Handedness side, const std::vector<Pose>& poses, RecordedFrame& frame);

  BvhText text_;
  RecordingHeader header_;
  Warnings warnings_;
  HandIntake intake_{1.0, HandIntake::Rotations::inferred};
  BvhSkeleton skeleton_;
  std::array<std::optional<BvhHand>, 2> hands_{};  ///< by index_of(Handedness)
  double unit_m_ = 1.0;
  std::int64_t frame_count_ = 0;  ///< as the file says
  double frame_time_s_ = 0.0;
  std::vector<double> numbers_;  ///< of a frame
  std::vector<bool> placed_;     ///< see `posed`
  std::int64_t read_ = 0;
  bool at_end_ = false;
};

}  // namespace nade::io
