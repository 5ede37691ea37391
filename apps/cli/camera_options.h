#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "nade/draw/camera.h"
#include "performance.h"

namespace nade::cli {

/// Whether a camera goes along with the hand.
enum class Follow : std::uint8_t {
  none,
  smooth,  ///< turned to where the hand is on average around that time
  locked,  ///< the hand stays where it is in the picture
};

/// --view, --eye, --target, --fov, --follow, as far as they were given.
struct CameraOptions {
  draw::View view = draw::View::three_quarter;
  std::optional<Vec3> eye;
  std::optional<Vec3> target;
  std::optional<double> fov_deg;
  Follow follow = Follow::none;
};

/// Adds the options to a command. What cannot be read is refused while parsing.
void add_camera_options(CLI::App& command, CameraOptions& options);

/// The camera of a film: knows where the hands will be.
class CameraPlan {
 public:
  /// `glimpses`: of the times that will be shown.
  CameraPlan(const CameraOptions& options, std::span<const Glimpse> glimpses);

  [[nodiscard]] draw::Camera at(std::int64_t time_ns, double aspect) const;

 private:
  void average(std::span<const Glimpse> glimpses);
  [[nodiscard]] Glimpse where(std::int64_t time_ns) const;

  CameraOptions options_;
  std::vector<Glimpse> path_;  ///< smoothed where that was asked for
  Glimpse still_;              ///< the middle of it all
  double radius_m_ = 0.2;      ///< of the ball that is framed
};

}  // namespace nade::cli
