#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nade/eval/synth.h"
#include "nade/io/object_file.h"
#include "nade/io/recording.h"
#include "nade/status.h"

namespace nade {

struct BenchScene;

/// One stroke of the suite: what moves how over which object.
struct SuiteCase {
  std::string object;  ///< of load_suite_object
  /// The stroke, where no recording takes its place.
  SynthOptions synth;
  /// A recording of real hands, a file of any known format.
  std::optional<std::string> clip;
  /// How deep the object is pressed against a clip's palms, metres.
  double press_m = 0.03;
  /// A scene that takes the stroke's place (nade/eval/scene.h).
  std::shared_ptr<const BenchScene> scene = nullptr;

  /// Whether methods are judged by it only and not tuned on it: strokes and tracker noise drawn
  /// from a third of all seeds.
  [[nodiscard]] bool is_held_out() const { return !clip && !scene && synth.seed % 3 == 0; }

  /// Whether a palm lies on something that it could lie flat on: a plane or a ball of 150 mm and
  /// more, pressed 10 mm and more.
  [[nodiscard]] bool is_flat() const;

  /// What tells it from the others, in words: "dog/back line 0.1 m/s 20 mm quest left". Only what
  /// is out of the ordinary is named after the depth.
  [[nodiscard]] std::string name() const;
};

enum class SuiteSize : std::uint8_t {
  quick,   ///< a dozen short strokes, for tests
  normal,  ///< one thing changed at a time, and a few dozen random strokes: about 120
  full,    ///< the same at every place, and 200 random strokes
};

struct SuiteOptions {
  SuiteSize size = SuiteSize::normal;
  /// Mesh files that are stroked too, at their place or their top.
  std::vector<std::string> mesh_files = {};
  /// Recordings of real hands, each pressed onto plane, sphere and dog.
  std::vector<std::string> clips = {};
  /// What hands do beside strokes; not in the quick suite.
  std::vector<std::shared_ptr<const BenchScene>> scenes = {};
};

/// The cases, the same on every machine.
[[nodiscard]] std::vector<SuiteCase> suite_cases(const SuiteOptions& options);

/// What a stroke follows.
enum class StrokeGuide : std::uint8_t {
  surface,  ///< the object's own surface
  plane,    ///< flat on, through the place: over an edge and beyond
};

/// An object of the suite.
struct SuiteObject {
  LoadedObject loaded;
  StrokeGuide guide = StrokeGuide::surface;
};

/// Loads "bowl", "board", "box" (nade/eval/shapes.h), or what load_object knows.
[[nodiscard]] Result<SuiteObject> load_suite_object(const std::string& name);

/// What is touched in a case.
[[nodiscard]] Result<SuiteObject> load_case_object(const SuiteCase& suite_case);

/// An object in one frame.
struct ObjectState {
  Placement placement;
  Vec3 stretch = Vec3::Ones();  ///< of its mesh, along its own axes about its origin
};

/// A mesh stretched so.
[[nodiscard]] TriangleSoup stretched(TriangleSoup soup, const Vec3& stretch);

/// A case as a recording.
struct CaseRecording {
  RecordingHeader header;  ///< bears the object and its placing
  Placement placement;     ///< of the object, at the beginning
  std::vector<RecordedFrame> frames;
  std::vector<ObjectState> states;  ///< by frame; empty: the object stands still
};

/// Makes the stroke or plays the scene, or reads the clip and presses the object against it.
/// `object` is the case's.
[[nodiscard]] Result<CaseRecording> make_recording(const SuiteCase& suite_case,
                                                   const SuiteObject& object);

/// An object from frame to frame of a recording: what a hand touches in each. One that stretches
/// has a mesh of its own here, so that others may look at `object` meanwhile.
class ObjectPlayer {
 public:
  /// Both must outlive the player.
  ObjectPlayer(const CaseRecording& recording, const SuiteObject& object);

  /// As it is in a frame, valid until the next call.
  [[nodiscard]] const Object& at(std::size_t frame);

 private:
  const CaseRecording* recording_;
  const SuiteObject* object_;
  std::unique_ptr<MeshSurface> stretching_;
  std::vector<Eigen::Vector3f> vertices_;
  Object now_;
};

}  // namespace nade
