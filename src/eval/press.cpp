#include "nade/eval/press.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "nade/hand_mesh.h"
#include "wall_memory.h"

namespace nade {
namespace {

constexpr double kReach_m = 0.5;
constexpr double kDepthMax_m = 0.2;
constexpr double kRise_m = 0.005;         // of the scan that finds where the depth is first passed
constexpr double kFarthest_m = 5.0;       // that the scan goes from the palms' median height
constexpr std::size_t kScanFrames = 600;  // enough for a median to a fraction of kRise_m
constexpr double kAbovePlace_m = 0.05;    // a wall higher than this over the place is another
constexpr double kNothing = -std::numeric_limits<double>::infinity();

double median(std::vector<double>& values) {
  if (values.empty()) return kNothing;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// From where an object is pressed.
struct Entry {
  Vec3 place = Vec3::Zero();
  Vec3 up = Vec3::UnitY();  ///< unit, out of the object there
};

/// How deep a point lies as seen from the side that was entered, where it is nearer to the far side
/// of a thin wall, or beyond it; no value elsewhere.
std::optional<double> depth_through(const Object& object, const Vec3& point,
                                    const SurfacePoint& nearest, const Entry& entry) {
  constexpr double kFacesAway = -0.5;
  if (nearest.normal.dot(entry.up) > kFacesAway) return std::nullopt;
  const auto side = side_above(object, point, entry.up);
  if (!side || !side->thin) return std::nullopt;
  const bool of_place = (side->point - entry.place).dot(entry.up) <= kAbovePlace_m;
  return of_place ? std::optional(side->depth_m) : std::nullopt;
}

/// The median over the frames of how deep the deeper palm lies.
double median_depth(const Object& object, std::span<const PalmSkin> frames,
                    const std::optional<Entry>& entry) {
  std::vector<double> depths;
  depths.reserve(frames.size());
  std::array<SurfaceHint, 2> hints;
  for (const PalmSkin& frame : frames) {
    double deepest = kNothing;
    for (std::size_t side = 0; side < frame.size(); ++side) {
      if (!frame[side]) continue;
      const auto nearest = object.closest_point(*frame[side], kReach_m, hints[side]);
      if (!nearest) continue;
      const auto through =
          entry ? depth_through(object, *frame[side], *nearest, *entry) : std::nullopt;
      deepest = std::max(deepest, through.value_or(-nearest->signed_distance));
    }
    depths.push_back(deepest);
  }
  return median(depths);
}

/// The frames' palms as seen by an object that is pushed about without turning.
class PressSearch {
 public:
  PressSearch(const LoadedObject& object, const Placement& placement,
              std::span<const PalmSkin> frames, double depth_m)
      : object_(object), start_(placement), all_(frames), depth_m_(depth_m) {
    const MeshPlace place = *object.place();
    up_ = (placement.pose.rotation * place.pose.rotation * Vec3::UnitY()).normalized();
    place_offset_ = placement.pose.rotation * (placement.scale * place.pose.position);
    right_ = up_.unitOrthogonal();
    const std::size_t stride = (frames.size() + kScanFrames - 1) / kScanFrames;
    for (std::size_t i = 0; i < frames.size(); i += stride) few_.push_back(frames[i]);
    find_heights();
  }

  /// With the place on the line along the normal through `under`; no value where the median
  /// never gets that deep.
  std::optional<Placement> solve_under(const Vec3& under) {
    const std::optional<double> reached = first_height(under);
    if (!reached) return std::nullopt;
    double above = *reached;
    double below = above - kRise_m;
    // The scan saw few of the frames: make sure that all of them agree on the bracket.
    for (int i = 0; i < 20 && depth_at(under, below, all_) >= depth_m_; ++i) below -= kRise_m;
    for (int i = 0; i < 20 && depth_at(under, above, all_) < depth_m_; ++i) above += kRise_m;
    if (depth_at(under, above, all_) < depth_m_) return std::nullopt;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (below + above);
      (depth_at(under, middle, all_) < depth_m_ ? below : above) = middle;
    }
    return placed(under, above);
  }

  /// The greatest median depth on the line through `under`.
  double deepest(const Vec3& under) {
    double best = kNothing;
    for (double height = lowest_; height <= highest_; height += 2.0 * kRise_m) {
      best = std::max(best, depth_at(under, height, few_));
    }
    return best;
  }

  /// Moves `under` across the normal toward where the median gets deepest: compass search.
  Vec3 searched(Vec3 under) {
    double best = deepest(under);
    const Vec3 forward = up_.cross(right_);
    for (double step = 0.08; step > 0.004 && best < depth_m_;) {
      const Vec3 from = under;
      for (const Vec3& way : {right_, forward, Vec3(-right_), Vec3(-forward)}) {
        const double depth = deepest(from + step * way);
        if (depth > best) {
          best = depth;
          under = from + step * way;
        }
      }
      if (under == from) step *= 0.5;
    }
    best_depth_m_ = std::max(best_depth_m_, best);
    return under;
  }

  [[nodiscard]] double best_depth() const { return best_depth_m_; }

 private:
  void find_heights() {
    lowest_ = std::numeric_limits<double>::infinity();
    highest_ = -lowest_;
    std::vector<double> heights;
    for (const PalmSkin& frame : few_) {
      for (const auto& point : frame) {
        if (!point) continue;
        heights.push_back(point->dot(up_));
        lowest_ = std::min(lowest_, heights.back());
        highest_ = std::max(highest_, heights.back());
      }
    }
    // A tracker's glitch may be anywhere, and does not move the median.
    const double middle = median(heights);
    lowest_ = std::max(lowest_, middle - kFarthest_m);
    highest_ = std::min(highest_, middle + kFarthest_m);
    lowest_ -= 0.02;
    highest_ += 2.0 * depth_m_ + 0.02;
  }

  [[nodiscard]] Placement placed(const Vec3& under, double height) const {
    Placement placement = start_;
    placement.pose.position = under + (height - under.dot(up_)) * up_ - place_offset_;
    return placement;
  }

  [[nodiscard]] double depth_at(const Vec3& under, double height,
                                std::span<const PalmSkin> frames) const {
    const Placement placement = placed(under, height);
    return median_depth(object_.placed(placement), frames,
                        Entry{placement.pose.position + place_offset_, up_});
  }

  std::optional<double> first_height(const Vec3& under) {
    for (double height = lowest_; height <= highest_; height += kRise_m) {
      const double depth = depth_at(under, height, few_);
      best_depth_m_ = std::max(best_depth_m_, depth);
      if (depth >= depth_m_) return height;
    }
    return std::nullopt;
  }

  const LoadedObject& object_;
  Placement start_;
  std::span<const PalmSkin> all_;
  std::vector<PalmSkin> few_;
  double depth_m_;
  Vec3 up_;
  Vec3 right_;
  Vec3 place_offset_;
  double lowest_ = 0.0;
  double highest_ = 0.0;
  double best_depth_m_ = kNothing;
};

/// The median point, coordinate by coordinate, of the hands in `sides`; no value without any.
std::optional<Vec3> median_point(std::span<const PalmSkin> frames,
                                 std::initializer_list<Handedness> sides) {
  std::array<std::vector<double>, 3> coordinates;
  for (const PalmSkin& frame : frames) {
    for (const Handedness side : sides) {
      const auto& point = frame[index_of(side)];
      if (!point) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        coordinates[k].push_back((*point)(static_cast<Eigen::Index>(k)));
      }
    }
  }
  if (coordinates[0].empty()) return std::nullopt;
  return Vec3(median(coordinates[0]), median(coordinates[1]), median(coordinates[2]));
}

}  // namespace

std::optional<Vec3> palm_skin(const HandPose& hand) noexcept {
  const double length = is_usable(hand) ? hand_length(hand) : 0.0;
  if (!(length > 0.0)) return std::nullopt;
  const double depth = generic_skin_depths()[Part::palm] * length / kGenericHandLength;
  return hand[Joint::palm].position - depth * hand.back();
}

void PalmTrack::add(const RecordedFrame& frame) {
  PalmSkin skin;
  for (std::size_t side = 0; side < skin.size(); ++side) {
    if (frame.hands[side]) skin[side] = palm_skin(frame.hands[side]->pose);
  }
  if (!skin[0] && !skin[1]) return;
  if (seen_++ % stride_ != 0) return;
  frames_.push_back(skin);
  if (frames_.size() < kCapacity) return;
  for (std::size_t i = 0; 2 * i < frames_.size(); ++i) frames_[i] = frames_[2 * i];
  frames_.resize((frames_.size() + 1) / 2);
  stride_ *= 2;
}

double median_depth(const Object& object, std::span<const PalmSkin> frames) {
  return median_depth(object, frames, std::nullopt);
}

Result<Placement> press(const LoadedObject& object, const Placement& placement,
                        const PalmTrack& track, double depth_m) {
  if (!(depth_m > 0.0 && depth_m <= kDepthMax_m)) {
    return Error{
        ErrorCode::out_of_range,
        fmt::format("--press {}: expected a depth above 0 and up to {} m", depth_m, kDepthMax_m)};
  }
  const auto both = median_point(track.frames(), {Handedness::left, Handedness::right});
  if (!both) {
    return Error{ErrorCode::bad_value,
                 fmt::format("--press {}: the recording has no usable hand to press", depth_m)};
  }
  PressSearch search(object, placement, track.frames(), depth_m);
  const std::array<std::optional<Vec3>, 3> candidates{
      both, median_point(track.frames(), {Handedness::right}),
      median_point(track.frames(), {Handedness::left})};
  for (const auto& candidate : candidates) {
    if (!candidate) continue;
    if (const auto solved = search.solve_under(*candidate)) return *solved;
  }
  for (const auto& candidate : candidates) {
    if (!candidate) continue;
    if (const auto solved = search.solve_under(search.searched(*candidate))) return *solved;
  }
  const std::string hint = size_hint(object, placement.scale);
  return Error{
      ErrorCode::bad_value,
      fmt::format("--press {}: under this recording's palms, {} can be no deeper than {:.4f} "
                  "m at the median{}{}",
                  depth_m, object.spec, std::max(0.0, search.best_depth()),
                  hint.empty() ? "" : "; it is ", hint)};
}

}  // namespace nade
