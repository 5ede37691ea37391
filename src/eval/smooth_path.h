#pragma once

#include <Eigen/Core>
#include <vector>

namespace nade {

/// A way through values at times, each number by itself: twice continuously differentiable, at rest
/// at both ends and where it turns back, and never beyond the values on either side.
class SmoothPath {
 public:
  /// As many values as times, at least one; all of a length. Times increase.
  SmoothPath(std::vector<double> times_s, std::vector<Eigen::VectorXd> values);

  /// Before and after the times the first and the last value.
  [[nodiscard]] Eigen::VectorXd at(double time_s) const;

 private:
  std::vector<double> times_s_;
  std::vector<Eigen::VectorXd> values_;
  std::vector<Eigen::VectorXd> slopes_;
};

}  // namespace nade
