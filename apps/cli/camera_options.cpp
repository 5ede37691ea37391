#include "camera_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "number_list.h"
#include "number_options.h"

namespace nade::cli {
namespace {

/// A ball about the palm with the hand in it, and some air.
constexpr double kHandRadius = 0.12;
/// Of a camera from the world's origin, metres: there nothing is seen any more.
constexpr double kFarthest = 1000.0;
/// Of the Gaussian that a followed path is smoothed with.
constexpr double kSmoothingNs = 0.4e9;

void add_point(CLI::App& command, const std::string& name, std::optional<Vec3>& point,
               const std::string& help) {
  command
      .add_option_function<std::string>(
          name,
          [&point, name](const std::string& text) {
            const auto numbers = parse_numbers<3>(text);
            if (!numbers) {
              throw CLI::ValidationError(
                  name, fmt::format("expected three numbers X,Y,Z, found '{}'", text));
            }
            point = Vec3(numbers->data());
            if (point->norm() > kFarthest) {
              throw CLI::ValidationError(
                  name,
                  fmt::format("expected a place within {:.0f} m, found '{}'", kFarthest, text));
            }
          },
          help)
      ->type_name("X,Y,Z");
}

/// A hand as far as a camera behind its wrist needs one.
HandPose hand_of(const Glimpse& glimpse) {
  HandPose hand;
  hand[Joint::wrist].position = glimpse.wrist;
  hand[Joint::middle_proximal].position = glimpse.knuckle;
  return hand;
}

Glimpse weighted(const Glimpse& a, double share_a, const Glimpse& b, double share_b) {
  Glimpse sum = a;
  sum.center = share_a * a.center + share_b * b.center;
  sum.wrist = share_a * a.wrist + share_b * b.wrist;
  sum.knuckle = share_a * a.knuckle + share_b * b.knuckle;
  return sum;
}

Glimpse smoothed_at(std::span<const Glimpse> path, std::size_t middle) {
  Glimpse sum = weighted(path[middle], 0.0, path[middle], 0.0);
  double total = 0.0;
  const auto add = [&](const Glimpse& other) {
    const double away = static_cast<double>(other.time_ns - path[middle].time_ns) / kSmoothingNs;
    if (std::abs(away) > 3.0) return false;
    const double weight = std::exp(-0.5 * away * away);
    sum = weighted(sum, 1.0, other, weight);
    total += weight;
    return true;
  };
  for (std::size_t i = middle; i < path.size() && add(path[i]); ++i) {
  }
  for (std::size_t i = middle; i-- > 0 && add(path[i]);) {
  }
  return weighted(sum, 1.0 / total, sum, 0.0);
}

}  // namespace

void add_camera_options(CLI::App& command, CameraOptions& options) {
  command
      .add_option_function<std::string>(
          "--view",
          [&options](const std::string& text) {
            const auto view = draw::view_from_name(text);
            if (!view) {
              throw CLI::ValidationError(
                  "--view",
                  fmt::format(
                      "expected front, side, top, three-quarter or first-person, found '{}'",
                      text));
            }
            options.view = *view;
          },
          "where it is seen from (default three-quarter)")
      ->type_name("front|side|top|three-quarter|first-person");
  add_point(command, "--eye", options.eye, "where the camera is, metres");
  add_point(command, "--target", options.target, "what it looks at, metres (default the hands)");
  command.add_option("--fov", options.fov_deg, "angle from the picture's bottom to its top")
      ->type_name("DEG")
      ->check(number_in(1.0, 150.0));
  command
      .add_option_function<std::string>(
          "--follow",
          [&options](const std::string& text) {
            if (text != "smooth" && text != "locked") {
              throw CLI::ValidationError(
                  "--follow", fmt::format("expected smooth or locked, found '{}'", text));
            }
            options.follow = text == "smooth" ? Follow::smooth : Follow::locked;
          },
          "the camera goes with the hand, smoothly or locked to it")
      ->type_name("smooth|locked");
}

CameraPlan::CameraPlan(const CameraOptions& options, std::span<const Glimpse> glimpses)
    : options_(options), radius_m_(kHandRadius) {
  average(glimpses);
  if (options.follow == Follow::none) return;
  path_.assign(glimpses.begin(), glimpses.end());
  if (options.follow == Follow::locked) return;
  for (std::size_t i = 0; i < path_.size(); ++i) path_[i] = smoothed_at(glimpses, i);
}

void CameraPlan::average(std::span<const Glimpse> glimpses) {
  if (glimpses.empty()) return;
  constexpr double kFar = std::numeric_limits<double>::max();
  Vec3 low = Vec3::Constant(kFar);
  Vec3 high = Vec3::Constant(-kFar);
  Glimpse sum;
  for (const Glimpse& glimpse : glimpses) {
    sum = weighted(sum, 1.0, glimpse, 1.0);
    low = low.cwiseMin(glimpse.center);
    high = high.cwiseMax(glimpse.center);
  }
  const double share = 1.0 / static_cast<double>(glimpses.size());
  still_ = weighted(sum, share, sum, 0.0);
  if (options_.follow != Follow::none) return;
  still_.center = 0.5 * (low + high);
  radius_m_ += 0.36 * (high - low).norm();
}

Glimpse CameraPlan::where(std::int64_t time_ns) const {
  if (path_.empty()) return still_;
  const auto after =
      std::lower_bound(path_.begin(), path_.end(), time_ns,
                       [](const Glimpse& g, std::int64_t time) { return g.time_ns < time; });
  if (after == path_.end()) return path_.back();
  if (after == path_.begin()) return path_.front();
  const Glimpse& before = *(after - 1);
  const double share = static_cast<double>(time_ns - before.time_ns) /
                       static_cast<double>(after->time_ns - before.time_ns);
  return weighted(before, 1.0 - share, *after, share);
}

draw::Camera CameraPlan::at(std::int64_t time_ns, double aspect) const {
  const Glimpse hand = where(time_ns);
  const Vec3 target = options_.target.value_or(hand.center);
  std::optional<double> vertical_rad;
  if (options_.fov_deg) vertical_rad = *options_.fov_deg * kDegree;
  if (options_.eye) {
    // Locked, the eye keeps its place beside the hand.
    const Vec3 moved =
        options_.follow == Follow::locked ? Vec3(hand.center - still_.center) : Vec3(Vec3::Zero());
    return draw::looking_at(*options_.eye + moved, target, vertical_rad.value_or(0.6), aspect);
  }
  if (options_.view == draw::View::first_person) {
    draw::Camera camera = draw::first_person(hand_of(hand), aspect);
    if (vertical_rad) camera.view = draw::symmetric_view(*vertical_rad, aspect);
    return camera;
  }
  // In an upright picture the width is what has to hold the ball.
  draw::Orbit orbit = draw::framed(options_.view, target, radius_m_ / std::min(1.0, aspect));
  if (vertical_rad) {
    orbit.distance_m *= std::tan(0.5 * orbit.vertical_view_rad) / std::tan(0.5 * *vertical_rad);
    orbit.vertical_view_rad = *vertical_rad;
  }
  return orbit.camera(aspect);
}

}  // namespace nade::cli
