#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nade/corrector.h"
#include "nade/eval/metrics.h"
#include "nade/eval/quantile.h"
#include "nade/eval/suite.h"
#include "nade/hand_mesh.h"
#include "nade/io/object_file.h"

namespace nade {

/// The hands that are drawn and measured, by index_of(Handedness).
struct DrawnHands {
  std::array<HandMesh, 2> meshes;
  std::array<std::shared_ptr<const HandFlesh>, 2> flesh;  ///< as a corrector takes it
};

/// The hands that come with the product. The error says where a file was looked for.
[[nodiscard]] Result<DrawnHands> load_drawn_hands();

/// What a method may know beforehand of the hand that it corrects.
struct SolverContext {
  const LoadedObject* object = nullptr;  ///< outlives the solver
  Placement placement;                   ///< of the object, at the beginning
  Handedness side = Handedness::right;
  /// The tracked hand's size over the drawn mesh's.
  double hand_scale = 1.0;
  std::shared_ptr<const HandFlesh> flesh;
};

/// Corrects one hand frame by frame, with a memory of its own; called as HandCorrector::update is.
using HandSolver = std::function<CorrectedHand(const HandPose& tracked, const Object& object,
                                               std::int64_t time_ns)>;

/// A way to keep a hand on a surface, to be compared with others.
struct ComparedMethod {
  std::string name;
  std::function<HandSolver(const SolverContext&)> make;
  /// Whether it can follow an object that moves; else it is left out where one does.
  bool follows_objects = true;
};

/// none, paper, nade and wrist-offset (nade/eval/wrist_offset.h).
[[nodiscard]] std::vector<ComparedMethod> library_methods();

/// The default method with other numbers than it has (src/proxy/tuning.h).
[[nodiscard]] ComparedMethod tuned_method(std::shared_ptr<const ProxyTuning> tuning);

/// The paper's, which targets refer to.
[[nodiscard]] ComparedMethod paper_method();

/// A recording as a method corrects it.
struct CorrectedRecording {
  std::vector<RecordedFrame> frames;
  QuantileSketch solve_us;  ///< wall time of each hand in each frame
};
[[nodiscard]] CorrectedRecording correct(const CaseRecording& tracked, const SuiteObject& object,
                                         const DrawnHands& hands, const ComparedMethod& method);

/// What a corrected recording is like, over both hands. A hand that only one of the two has is a
/// gap.
[[nodiscard]] Metrics measure(const CaseRecording& tracked, const SuiteObject& object,
                              const DrawnHands& hands, const CorrectedRecording& corrected);

/// How one method did in one case.
struct CaseScore {
  Metrics metrics;
  std::optional<double> solve_us_median;
  std::optional<double> solve_us_p99;
};

/// Corrects and measures. The linkage along the surface is left out of press strokes, where the
/// object moves (a hand goes along with it), and where the tracked palm goes less than 50 mm along
/// it while it lies in the solid: there is none.
[[nodiscard]] CaseScore score(const SuiteCase& suite_case, const CaseRecording& tracked,
                              const SuiteObject& object, const DrawnHands& hands,
                              const ComparedMethod& method);

/// How bad a value of a metric is, for finding the worst: the larger, the farther from its bounds,
/// or from 0 where it has none.
[[nodiscard]] double badness(const MetricBounds& bounds, double value);

}  // namespace nade
