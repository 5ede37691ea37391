#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "room.h"

namespace nade::xr {

/// The last frames' costs, in room made beforehand.
class FrameCosts {
 public:
  FrameCosts();

  /// Does not allocate. The first frames, in which drivers compile, do not count.
  void add(const FrameCost& cost) noexcept;
  [[nodiscard]] std::size_t frames() const { return counted_; }
  /// Of the corrections, the median; milliseconds; 0 before there are any.
  [[nodiscard]] double last_correction_us() const { return last_correction_us_; }

  struct Sum {
    double median_ms = 0.0;
    double p99_ms = 0.0;
  };
  struct Report {
    Sum correct;
    Sum pose;
    Sum submit;
    Sum together;
  };
  [[nodiscard]] Report report() const;

 private:
  std::vector<FrameCost> costs_;
  std::size_t seen_ = 0;
  std::size_t counted_ = 0;
  double last_correction_us_ = 0.0;
};

/// The report as sentences for a person.
[[nodiscard]] std::string as_text(const FrameCosts& costs);

}  // namespace nade::xr
