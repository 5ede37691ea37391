#include "gltf_animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

// Based on: The Khronos Group. glTF 2.0 Specification. 2021 (appendix C, animation sampler
// interpolation modes).
// Based on: Shoemake. Animating Rotation with Quaternion Curves. 1985.

namespace nade::gltf {
namespace {

std::optional<Property> property_from(std::string_view path) {
  if (path == "translation") return Property::translation;
  if (path == "rotation") return Property::rotation;
  if (path == "scale") return Property::scale;
  if (path == "weights") return Property::weights;
  return std::nullopt;
}

std::optional<Interpolation> interpolation_from(std::string_view name) {
  if (name.empty() || name == "LINEAR") return Interpolation::linear;
  if (name == "STEP") return Interpolation::step;
  if (name == "CUBICSPLINE") return Interpolation::cubic;
  return std::nullopt;
}

void normalise(std::span<double> quaternion) {
  double squared = 0.0;
  for (const double c : quaternion) squared += c * c;
  const double length = std::sqrt(squared);
  if (!(length > 1e-9)) {
    std::fill(quaternion.begin(), quaternion.end(), 0.0);
    quaternion.back() = 1.0;
    return;
  }
  for (double& c : quaternion) c /= length;
}

void slerp(const float* from, const float* to, double share, std::span<double> value) {
  double cosine = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    cosine += static_cast<double>(from[i]) * static_cast<double>(to[i]);
  }
  const double sign = cosine < 0.0 ? -1.0 : 1.0;
  const double angle = std::acos(std::clamp(std::abs(cosine), 0.0, 1.0));
  double near = 1.0 - share;
  double far = share;
  if (angle > 1e-4) {
    near = std::sin((1.0 - share) * angle) / std::sin(angle);
    far = std::sin(share * angle) / std::sin(angle);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    value[i] = near * static_cast<double>(from[i]) + sign * far * static_cast<double>(to[i]);
  }
}

/// A track while it is read.
struct Channel {
  const tinygltf::Model& model;
  const std::string& path;
  const tinygltf::Animation& animation;
  std::size_t index;

  [[nodiscard]] Error bad(std::string_view expected) const {
    return {ErrorCode::bad_format, fmt::format("{}: animation '{}': channel {}: {}", path,
                                               animation.name, index, expected)};
  }
};

Status check(const Channel& channel, const Track& track) {
  const std::size_t each = track.width * (track.interpolation == Interpolation::cubic ? 3 : 1);
  if (track.times.empty() || track.values.size() != each * track.times.size()) {
    return channel.bad(fmt::format("expected {} numbers for {} keys, found {}",
                                   each * track.times.size(), track.times.size(),
                                   track.values.size()));
  }
  const auto finite = [](float number) { return std::isfinite(number); };
  if (!std::all_of(track.times.begin(), track.times.end(), finite) ||
      !std::is_sorted(track.times.begin(), track.times.end()) || track.times.front() < 0.0F) {
    return channel.bad("expected times from 0 on that do not go back");
  }
  if (!std::all_of(track.values.begin(), track.values.end(), finite)) {
    return channel.bad("expected finite numbers");
  }
  return ok_status();
}

Result<Track> read_track(const Channel& channel, const tinygltf::AnimationSampler& sampler,
                         Track track) {
  const auto interpolation = interpolation_from(sampler.interpolation);
  if (!interpolation) {
    return channel.bad(
        fmt::format("expected LINEAR, STEP or CUBICSPLINE, found '{}'", sampler.interpolation));
  }
  track.interpolation = *interpolation;
  Result<std::vector<float>> times =
      read_floats({channel.model, channel.path, "animation's times", sampler.input}, 1);
  if (!times) return times.error();
  const bool scalars = track.property == Property::weights;
  Result<std::vector<float>> values =
      read_floats({channel.model, channel.path, "animation's values", sampler.output},
                  scalars ? 1 : static_cast<int>(track.width));
  if (!values) return values.error();
  track.times = std::move(*times);
  track.values = std::move(*values);
  const Status fits = check(channel, track);
  if (!fits) return fits.error();
  return track;
}

}  // namespace

void Track::at(double time_s, std::span<double> value) const noexcept {
  const std::size_t each = width * (interpolation == Interpolation::cubic ? 3 : 1);
  const auto after = std::upper_bound(times.begin(), times.end(), time_s,
                                      [](double t, float key) { return t < double{key}; });
  const auto next = static_cast<std::size_t>(after - times.begin());
  const std::size_t key = next == 0 ? 0 : next - 1;
  const float* const from = values.data() + each * key;
  const float* const at_key = interpolation == Interpolation::cubic ? from + width : from;
  if (next == 0 || next == times.size() || interpolation == Interpolation::step) {
    std::copy(at_key, at_key + width, value.begin());
    if (property == Property::rotation) normalise(value);
    return;
  }
  const double span_s = double{times[next]} - double{times[key]};
  const double t = (time_s - double{times[key]}) / span_s;
  const float* const to = from + each;
  if (interpolation == Interpolation::cubic) {
    const double t2 = t * t;
    const double t3 = t2 * t;
    for (std::size_t i = 0; i < width; ++i) {
      value[i] = (2.0 * t3 - 3.0 * t2 + 1.0) * double{from[width + i]} +
                 span_s * (t3 - 2.0 * t2 + t) * double{from[2 * width + i]} +
                 (3.0 * t2 - 2.0 * t3) * double{to[width + i]} + span_s * (t3 - t2) * double{to[i]};
    }
  } else if (property == Property::rotation) {
    slerp(from, to, t, value);
  } else {
    for (std::size_t i = 0; i < width; ++i) {
      value[i] = (1.0 - t) * double{from[i]} + t * double{to[i]};
    }
  }
  if (property == Property::rotation) normalise(value);
}

std::vector<MeshAnimation> animations_of(const tinygltf::Model& model) {
  std::vector<MeshAnimation> all;
  for (const tinygltf::Animation& animation : model.animations) {
    MeshAnimation& known = all.emplace_back();
    known.name = animation.name;
    for (const tinygltf::AnimationSampler& sampler : animation.samplers) {
      const auto times = static_cast<std::size_t>(sampler.input);
      if (sampler.input < 0 || times >= model.accessors.size()) continue;
      // The format asks for the greatest time here.
      const std::vector<double>& greatest = model.accessors[times].maxValues;
      if (!greatest.empty()) known.duration_s = std::max(known.duration_s, greatest.front());
    }
  }
  return all;
}

Result<std::vector<Track>> read_tracks(const tinygltf::Model& model, const std::string& path,
                                       const tinygltf::Animation& animation,
                                       std::span<const std::size_t> morph_targets) {
  std::vector<Track> tracks;
  for (std::size_t i = 0; i < animation.channels.size(); ++i) {
    const tinygltf::AnimationChannel& from = animation.channels[i];
    const Channel channel{model, path, animation, i};
    const std::optional<Property> property = property_from(from.target_path);
    const auto node = static_cast<std::size_t>(from.target_node);
    if (!property || from.target_node < 0 || node >= morph_targets.size()) continue;
    const auto sampler = static_cast<std::size_t>(from.sampler);
    if (from.sampler < 0 || sampler >= animation.samplers.size()) {
      return channel.bad(fmt::format("no such sampler {}", from.sampler));
    }
    Track track;
    track.node = node;
    track.property = *property;
    track.width = *property == Property::rotation  ? 4
                  : *property == Property::weights ? morph_targets[node]
                                                   : 3;
    if (track.width == 0) continue;
    Result<Track> read = read_track(channel, animation.samplers[sampler], std::move(track));
    if (!read) return read.error();
    tracks.push_back(std::move(read).value());
  }
  return tracks;
}

}  // namespace nade::gltf
