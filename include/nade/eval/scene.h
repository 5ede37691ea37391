#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "nade/eval/noise.h"
#include "nade/eval/suite.h"
#include "nade/hand.h"
#include "nade/mesh.h"
#include "nade/status.h"

namespace nade {

/// How a digit is bent: flexions of its three hinges from the base, radians, 0 straight.
struct Bend {
  double base = 0.0;
  double middle = 0.0;
  double last = 0.0;
  std::optional<double> abduction{};  ///< of the base; as relaxed where there is none
};
/// By index_of(Digit); a digit without a bend is as relaxed.
using Gesture = std::array<std::optional<Bend>, kDigitCount>;

/// A gesture by its name in docs/formats.md, "fist".
[[nodiscard]] std::optional<Gesture> gesture_from_name(std::string_view name);
/// All of them, parted by commas.
[[nodiscard]] std::string gesture_names();

/// First about Z, then about X, then about Y, radians.
[[nodiscard]] Quat turned_by(const Vec3& turn_rad);

/// What of a hand is put where a key says.
enum class SceneAnchor : std::uint8_t {
  palm,    ///< the palm's skin
  lowest,  ///< over the palm joint, the height of the hand's lowest skin
};

/// Where a right hand is at a time, and how it is held. Unturned its palm looks down (-Y) and its
/// fingers ahead (-Z).
struct SceneKey {
  double time_s = 0.0;
  Vec3 at = Vec3::Zero();
  std::variant<SceneAnchor, Joint> anchor = SceneAnchor::palm;
  Vec3 turn_rad = Vec3::Zero();  ///< of turned_by
  Gesture gesture{};
};

/// Where an object is at a time.
struct SceneMotionKey {
  double time_s = 0.0;
  Vec3 at = Vec3::Zero();
  Vec3 turn_rad = Vec3::Zero();
  Vec3 stretch = Vec3::Ones();  ///< along the object's own axes, about its origin
};

/// The tracker loses the hands.
struct SceneLoss {
  double time_s = 0.0;
  double duration_s = 0.0;
};
/// The tracker takes each hand for the other.
struct SceneSwap {
  double time_s = 0.0;
  double duration_s = 0.0;
};
/// The tracker puts the hands elsewhere: moved and turned about the palm, world.
struct SceneGlitch {
  double time_s = 0.0;
  std::size_t frames = 1;
  Pose error;
};
using SceneFault = std::variant<SceneLoss, SceneSwap, SceneGlitch>;

/// What a hand does to an object, as a file of tests/scenes says it (docs/formats.md, "Scenes").
struct BenchScene {
  std::string name;    ///< the file's, without folder and ending
  std::string what;    ///< in a sentence
  std::string object;  ///< of load_suite_object; empty where it is made of `soup`
  TriangleSoup soup;
  std::string place;                       ///< of the object: the path's frame; empty: the world's
  std::array<bool, 2> hands{false, true};  ///< by index_of(Handedness); a left one does the
                                           ///< mirror image, in x = 0 of the path's frame
  double hand_scale = 1.0;
  double rate_hz = 90.0;
  NoiseModel noise = NoiseModel::none;
  std::uint64_t seed = 1;
  std::vector<SceneKey> path;          ///< never empty, times increase
  std::vector<SceneMotionKey> motion;  ///< empty: the object stands at the origin
  std::vector<SceneFault> faults;
  /// Between these the tracked hand's skin is at its deepest, metres: what tests hold it to.
  double depth_least_m = 0.0;
  double depth_most_m = 1.0;
};

/// Reads a scene. The error names the file and the element, and says what was expected.
[[nodiscard]] Result<BenchScene> read_scene(const std::string& path);

/// All scenes (.json) of a folder, by name. The error of the first that cannot be read.
[[nodiscard]] Result<std::vector<std::shared_ptr<const BenchScene>>> read_scenes(
    const std::string& folder);

/// What is touched in a scene.
[[nodiscard]] Result<SuiteObject> load_scene_object(const BenchScene& scene);

/// A scene as a recording. `object` is its.
[[nodiscard]] Result<CaseRecording> make_scene_recording(const BenchScene& scene,
                                                         const SuiteObject& object);

}  // namespace nade
