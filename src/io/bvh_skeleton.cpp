#include "bvh_skeleton.h"

// Based on: Meredith, Maddock. Motion Capture File Formats Explained. 2001.

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "mesh_words.h"
#include "recording_limits.h"

namespace nade::io {
namespace {

constexpr std::size_t kMostBvhJoints = 10'000;
constexpr std::size_t kDeepestBvhJoint = 200;
constexpr std::size_t kMostBvhChannels = 6;
constexpr std::array<std::string_view, 6> kBvhChannelNames{"xposition", "yposition", "zposition",
                                                           "xrotation", "yrotation", "zrotation"};

std::optional<BvhChannel> bvh_channel_from(std::string_view word) {
  for (std::size_t i = 0; i < kBvhChannelNames.size(); ++i) {
    if (lower(word) == kBvhChannelNames[i]) return static_cast<BvhChannel>(i);
  }
  return std::nullopt;
}

/// The joints up to MOTION, with those open that are not yet closed.
class HierarchyReader {
 public:
  explicit HierarchyReader(BvhText& text) : text_(text) {}

  Result<BvhSkeleton> read() {
    const std::string_view first = text_.word();
    if (lower(first) != "hierarchy") return text_.expected("HIERARCHY", first);
    while (true) {
      const std::string word = lower(text_.word());
      if (open_.empty() && word == "motion") break;
      const Status status = open_.empty() ? take_root(word) : take_member(word);
      if (!status) return status.error();
    }
    if (skeleton_.joints.empty()) return text_.expected("ROOT", "MOTION");
    return std::move(skeleton_);
  }

 private:
  Status take_root(const std::string& word) {
    if (word != "root") return text_.expected("ROOT or MOTION", word);
    return begin_joint(false);
  }
  Status take_member(const std::string& word) {
    if (word == "offset") return read_offset();
    if (word == "channels") return read_channels();
    if (word == "joint") return begin_joint(false);
    if (word == "end") {
      const std::string_view site = text_.word();
      if (lower(site) != "site") return text_.expected("End Site", site);
      return begin_joint(true);
    }
    if (word != "}") return text_.expected("OFFSET, CHANNELS, JOINT, End Site or }", word);
    open_.pop_back();
    return ok_status();
  }
  Status begin_joint(bool is_end) {
    BvhJoint joint;
    joint.is_end = is_end;
    if (!open_.empty()) joint.parent = open_.back();
    if (!is_end) joint.name = text_.rest_of_line();
    if (skeleton_.joints.size() == kMostBvhJoints) {
      return text_.expected(fmt::format("at most {} joints", kMostBvhJoints), "more");
    }
    if (open_.size() == kDeepestBvhJoint) {
      return text_.expected(fmt::format("joints nested at most {} deep", kDeepestBvhJoint), "more");
    }
    const std::string_view brace = text_.word();
    if (brace != "{") return text_.expected("{", brace);
    open_.push_back(skeleton_.joints.size());
    skeleton_.joints.push_back(std::move(joint));
    return ok_status();
  }
  Status read_offset() {
    for (double& number : skeleton_.joints[open_.back()].offset) {
      const std::string_view word = text_.word();
      if (!parse_word(word, number) || !(std::abs(number) <= kFarthest_m)) {
        return text_.expected("OFFSET and three numbers", word);
      }
    }
    return ok_status();
  }
  Status read_channels() {
    BvhJoint& joint = skeleton_.joints[open_.back()];
    if (!joint.channels.empty()) return text_.expected("CHANNELS once in a joint", "another");
    const std::string_view word = text_.word();
    std::size_t count = 0;
    if (!parse_word(word, count) || count > kMostBvhChannels) {
      return text_.expected(fmt::format("CHANNELS and their number, 0 to {}", kMostBvhChannels),
                            word);
    }
    joint.first_channel = skeleton_.channel_count;
    skeleton_.channel_count += count;
    for (; count > 0; --count) {
      const std::string_view name = text_.word();
      const std::optional<BvhChannel> channel = bvh_channel_from(name);
      if (!channel) return text_.expected("a channel, as Xposition or Zrotation", name);
      joint.channels.push_back(*channel);
    }
    return ok_status();
  }

  BvhText& text_;
  BvhSkeleton skeleton_;
  std::vector<std::size_t> open_;
};

/// What the channels of a joint say.
struct ChannelPose {
  Vec3 position = Vec3::Zero();
  Quat rotation = Quat::Identity();
};

ChannelPose channel_pose(const BvhJoint& joint, const std::vector<double>& numbers) {
  ChannelPose pose;
  for (std::size_t i = 0; i < joint.channels.size(); ++i) {
    const double number = numbers[joint.first_channel + i];
    const auto axis = static_cast<Eigen::Index>(joint.channels[i]) % 3;
    if (joint.channels[i] < BvhChannel::turn_x) {
      pose.position[axis] = number;
    } else {
      pose.rotation = pose.rotation * Eigen::AngleAxisd(number * kDegree, Vec3::Unit(axis));
    }
  }
  return pose;
}

}  // namespace

bool BvhJoint::moves() const {
  for (const BvhChannel channel : channels) {
    if (channel < BvhChannel::turn_x) return true;
  }
  return false;
}

Result<BvhSkeleton> read_bvh_skeleton(BvhText& text) { return HierarchyReader(text).read(); }

std::vector<Vec3> rest_positions(const BvhSkeleton& skeleton) {
  std::vector<Vec3> positions;
  positions.reserve(skeleton.joints.size());
  for (const BvhJoint& joint : skeleton.joints) {
    positions.push_back(joint.parent ? Vec3(positions[*joint.parent] + joint.offset)
                                     : joint.offset);
  }
  return positions;
}

std::vector<Pose> posed(const BvhSkeleton& skeleton, const std::vector<double>& numbers,
                        const std::vector<bool>& placed) {
  std::vector<Pose> poses;
  poses.reserve(skeleton.joints.size());
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    const BvhJoint& joint = skeleton.joints[i];
    const ChannelPose said = channel_pose(joint, numbers);
    const Pose local{placed[i] ? said.position : Vec3(joint.offset + said.position), said.rotation};
    poses.push_back(joint.parent ? poses[*joint.parent] * local : local);
  }
  return poses;
}

std::vector<bool> placed_by_channels(const BvhSkeleton& skeleton,
                                     const std::vector<double>& numbers) {
  std::vector<bool> placed;
  placed.reserve(skeleton.joints.size());
  for (const BvhJoint& joint : skeleton.joints) {
    const Vec3 said = channel_pose(joint, numbers).position;
    placed.push_back(joint.moves() && (said - joint.offset).norm() <= said.norm());
  }
  return placed;
}

}  // namespace nade::io
