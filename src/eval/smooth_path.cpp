#include "smooth_path.h"

#include <algorithm>
#include <utility>

// Based on: Fritsch and Butland. A Method for Constructing Local Monotone Piecewise Cubic
// Interpolants. 1984. (the slopes; ours are quintic, without acceleration at the keys)

namespace nade {

SmoothPath::SmoothPath(std::vector<double> times_s, std::vector<Eigen::VectorXd> values)
    : times_s_(std::move(times_s)),
      values_(std::move(values)),
      slopes_(values_.size(), Eigen::VectorXd::Zero(values_.front().size())) {
  for (std::size_t i = 1; i + 1 < values_.size(); ++i) {
    const Eigen::ArrayXd before =
        (values_[i] - values_[i - 1]).array() / (times_s_[i] - times_s_[i - 1]);
    const Eigen::ArrayXd after =
        (values_[i + 1] - values_[i]).array() / (times_s_[i + 1] - times_s_[i]);
    const Eigen::ArrayXd product = before * after;
    // The harmonic mean, where both go the same way.
    slopes_[i] = (product > 0.0).select(2.0 * product / (before + after), 0.0).matrix();
  }
}

Eigen::VectorXd SmoothPath::at(double time_s) const {
  const auto next = std::upper_bound(times_s_.begin(), times_s_.end(), time_s);
  if (next == times_s_.begin()) return values_.front();
  if (next == times_s_.end()) return values_.back();
  const auto i = static_cast<std::size_t>(next - times_s_.begin());
  const double length_s = times_s_[i] - times_s_[i - 1];
  const double s = (time_s - times_s_[i - 1]) / length_s;
  const double cubed = s * s * s;
  const double share = cubed * (10.0 + s * (-15.0 + 6.0 * s));
  const double leave = s - cubed * (6.0 + s * (-8.0 + 3.0 * s));
  const double arrive = -cubed * (4.0 + s * (-7.0 + 3.0 * s));
  return (1.0 - share) * values_[i - 1] + share * values_[i] +
         length_s * (leave * slopes_[i - 1] + arrive * slopes_[i]);
}

}  // namespace nade
