#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "nade/hand_mesh.h"
#include "nade/io/recording.h"
#include "nade/status.h"

namespace nade::io {

/// Whether a file's name says that it holds a model: ".glb".
[[nodiscard]] bool names_a_model(const std::string& path);

/// A recording as a glTF model: the skinned hands that come with nade, of the size that each hand
/// has at the median, animated as they were recorded.
/// Source: Khronos Group. glTF 2.0 specification, 3.7.3 "Skins", 3.11 "Animations", 4.4 "Binary
/// glTF Layout".
class AnimatedHands {
 public:
  /// The error says where the hands' files were looked for.
  [[nodiscard]] static Result<AnimatedHands> create(const RecordingHeader& header,
                                                    const ModelOptions& options);

  /// A frame of usable hands, later than the ones before.
  void add(const RecordedFrame& frame);

  /// The model's bytes. The error where they are more than a file of that kind can have.
  [[nodiscard]] Result<std::string> as_glb() const;

  /// Where a joint is, as a file has it. One for each joint but the palm, which goes with the
  /// middle metacarpal.
  struct Place {
    std::array<float, 3> position;
    std::array<float, 4> rotation;
  };
  static constexpr std::size_t kBones = kJointCount - 1;

  /// A hand's frames, and what touched in them.
  struct Track {
    HandMesh mesh;
    std::vector<float> times_s;
    std::vector<std::array<Place, kBones>> places;  ///< world
    std::vector<float> scales;
    std::vector<std::size_t> begins;  ///< frames before which the hand was missing
    nlohmann::ordered_json contacts = nlohmann::ordered_json::object();  ///< by part
  };

 private:
  std::string header_json_;
  ModelOptions options_;
  std::array<Track, 2> tracks_;  ///< by index_of(Handedness)
  std::vector<float> times_s_;   ///< of all frames
  std::optional<std::int64_t> first_ns_;
  std::array<bool, 2> seen_before_{};
};

}  // namespace nade::io
