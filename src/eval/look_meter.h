#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bend_meter.h"
#include "nade/eval/quantile.h"
#include "nade/skin.h"
#include "nade/surface.h"

namespace nade {

/// How a corrected hand looks: what of its palm rests on the surface, and where it is drawn.
struct Look {
  std::optional<double> print_share;
  std::optional<double> hover_mm;
  std::optional<double> heel_share;
  std::optional<double> excess_max_mm;
  std::optional<double> excess_mean_mm;
  std::optional<double> along_p95_mm;
  std::optional<double> free_max_mm;
  std::optional<double> turn_median_deg;
  std::optional<double> turn_p95_deg;
};

/// One frame's hands, and how deep the tracked skin is: the signed distance of its deepest vertex,
/// or a lower bound of one that is outside.
struct LookFrame {
  std::int64_t time_ns = 0;
  const HandPose& tracked;
  const HandPose& corrected;
  double tracked_lowest_m = 0.0;
  Pressing pressing = Pressing::no;
};

/// Looks at all of the skin of both hands.
class LookMeter {
 public:
  LookMeter(const HandMesh& mesh, double scale);

  void add(const LookFrame& frame, const Object& object);
  /// The next hand does not go on from the last one.
  void break_off() { free_since_ns_.reset(); }
  void merge(const LookMeter& other);
  [[nodiscard]] Look finish() const;

 private:
  /// The signed distances of a posed skin's vertices.
  struct Field {
    explicit Field(std::size_t vertices) : hints(vertices), skin(vertices), distance_m(vertices) {}

    std::vector<SurfaceHint> hints;
    std::vector<Eigen::Vector3f> skin;
    std::vector<double> distance_m;  ///< `kFar_m` where it is more, or was not looked at
  };
  struct Mean {
    double sum = 0.0;
    double count = 0.0;
    void add(double value) {
      sum += value;
      count += 1.0;
    }
    void merge(const Mean& other) {
      sum += other.sum;
      count += other.count;
    }
    [[nodiscard]] std::optional<double> value() const {
      return count > 0.0 ? std::optional(sum / count) : std::nullopt;
    }
  };

  enum class Looked : std::uint8_t { all, palmar };
  void read(const HandPose& hand, const Object& object, Looked looked, Field& field) const;
  void take_print();
  void take_excess(Pressing pressing);
  void take_place(const LookFrame& frame, const Object& object);

  const HandMesh* mesh_;
  double scale_;
  SkinMap skin_;
  double heel_m2_ = 0.0;
  Field tracked_;
  Field corrected_;
  SurfaceHint palm_hint_;
  std::optional<std::int64_t> free_since_ns_;

  Mean print_;
  Mean hover_m_;
  Mean heel_;
  Mean excess_m_;
  std::optional<double> excess_max_m_;
  std::optional<double> free_max_m_;
  QuantileSketch along_mm_;
  QuantileSketch turn_deg_;
};

}  // namespace nade
