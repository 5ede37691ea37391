#include "mcap_write.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "nade/io/output_file.h"
#include "nade/version.h"
#include "recording_names.h"

namespace nade::io {
namespace {

using Messages = nlohmann::ordered_json;

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
constexpr const char* kFrameOfReference = "world";

Messages number_schema() { return {{"type", "number"}}; }

Messages object_schema(Messages properties) {
  return {{"type", "object"}, {"properties", std::move(properties)}};
}

Messages array_schema(Messages items) { return {{"type", "array"}, {"items", std::move(items)}}; }

Messages vector_schema() {
  return object_schema({{"x", number_schema()}, {"y", number_schema()}, {"z", number_schema()}});
}

Messages pose_schema() {
  Messages turn = vector_schema();
  turn["properties"]["w"] = number_schema();
  return object_schema({{"position", vector_schema()}, {"orientation", std::move(turn)}});
}

/// A message with a time, and whatever else.
std::string message_schema(std::string_view title, const Messages& properties) {
  Messages all{{"timestamp", object_schema({{"sec", {{"type", "integer"}, {"minimum", 0}}},
                                            {"nsec", {{"type", "integer"}, {"minimum", 0}}}})},
               {"frame_id", {{"type", "string"}}}};
  all.update(properties);
  Messages schema = object_schema(std::move(all));
  schema["title"] = title;
  return schema.dump();
}

std::string contacts_schema() {
  return message_schema("nade.Contacts",
                        {{"contacts", array_schema(object_schema({{"part", {{"type", "string"}}},
                                                                  {"point", vector_schema()},
                                                                  {"normal", vector_schema()},
                                                                  {"depth", number_schema()}}))}});
}

std::string state_schema() {
  return message_schema("nade.HandState", {{"confidence", number_schema()},
                                           {"status", {{"type", "string"}}},
                                           {"radii", array_schema(number_schema())}});
}

Messages vector_json(const Vec3& at) { return {{"x", at.x()}, {"y", at.y()}, {"z", at.z()}}; }

Messages pose_json(const Pose& pose) {
  const Quat& turn = pose.rotation;
  return {{"position", vector_json(pose.position)},
          {"orientation", {{"x", turn.x()}, {"y", turn.y()}, {"z", turn.z()}, {"w", turn.w()}}}};
}

Messages message_at(std::int64_t time_ns) {
  return {{"timestamp",
           {{"sec", time_ns / kNanosecondsPerSecond}, {"nsec", time_ns % kNanosecondsPerSecond}}},
          {"frame_id", kFrameOfReference}};
}

Messages joints_json(const HandPose& pose) {
  Messages poses = Messages::array();
  for (const Pose& joint : pose.joints) poses.push_back(pose_json(joint));
  return poses;
}

Messages contacts_json(const RecordedHand& hand) {
  Messages contacts = Messages::array();
  for (std::size_t part = 0; part < kPartCount; ++part) {
    if (!hand.contact[part]) continue;
    contacts.push_back({{"part", name_of(part_at(part))},
                        {"point", vector_json(hand.contact[part]->point)},
                        {"normal", vector_json(hand.contact[part]->normal)},
                        {"depth", hand.contact[part]->depth_m}});
  }
  return contacts;
}

std::string joint_names() {
  std::string names;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    names += fmt::format("{}{}", i == 0 ? "" : " ", name_of(joint_at(i)));
  }
  return names;
}

McapFile::Map header_map(const RecordingHeader& header) {
  McapFile::Map map{{"source", header.source},
                    {"hand_scale_known", header.hand_scale_known ? "true" : "false"}};
  if (!header.created.empty()) map["created"] = header.created;
  const Messages other = Messages::parse(header.unknown_json, nullptr, false);
  if (!other.is_object()) return map;
  for (const auto& [key, value] : other.items()) {
    map[key] = value.is_string() ? value.get<std::string>()
                                 : value.dump(-1, ' ', false, Messages::error_handler_t::replace);
  }
  return map;
}

}  // namespace

bool names_a_log(const std::string& path) { return content_ending_of(path) == ".mcap"; }

McapRecording::McapRecording(const RecordingHeader& header)
    : file_(fmt::format("nade {}", version())) {
  const std::uint16_t joints = file_.add_schema(
      "foxglove.PosesInFrame",
      message_schema("foxglove.PosesInFrame", {{"poses", array_schema(pose_schema())}}));
  const std::uint16_t head = file_.add_schema(
      "foxglove.PoseInFrame", message_schema("foxglove.PoseInFrame", {{"pose", pose_schema()}}));
  const std::uint16_t state = file_.add_schema("nade.HandState", state_schema());
  const std::uint16_t contacts = file_.add_schema("nade.Contacts", contacts_schema());
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    Channels& channels = channels_[index_of(side)];
    const std::string hand = fmt::format("/hands/{}", name_of(side));
    channels.joints = file_.add_channel(joints, hand + "/joints", {{"joints", joint_names()}});
    channels.state = file_.add_channel(state, hand + "/state", {{"joints", joint_names()}});
    channels.contacts = file_.add_channel(contacts, hand + "/contacts", {});
  }
  head_ = file_.add_channel(head, "/head", {});
  file_.add_metadata(std::string(kFormatName), header_map(header));
}

Status McapRecording::add(const RecordedFrame& frame) {
  if (frame.time_ns < 0) {
    return Error{ErrorCode::bad_value,
                 fmt::format("frame at {} ns: expected a time of 0 or more, for MCAP has no others",
                             frame.time_ns)};
  }
  const auto time_ns = static_cast<std::uint64_t>(frame.time_ns);
  const auto send = [&](std::uint16_t channel, const Messages& content) {
    Messages message = message_at(frame.time_ns);
    message.update(content);
    file_.add_message(channel, time_ns, message.dump());
  };
  for (const std::optional<RecordedHand>& hand : frame.hands) {
    if (!hand) continue;
    const Channels& channels = channels_[index_of(hand->pose.side)];
    send(channels.joints, {{"poses", joints_json(hand->pose)}});
    Messages state{{"confidence", hand->pose.confidence}, {"radii", hand->pose.radius}};
    if (hand->status) state["status"] = kStatusNames[static_cast<std::size_t>(*hand->status)];
    send(channels.state, state);
    // A corrected hand says so where nothing touches.
    Messages contacts = contacts_json(*hand);
    if (hand->status || !contacts.empty()) {
      send(channels.contacts, {{"contacts", std::move(contacts)}});
    }
  }
  if (frame.head) send(head_, {{"pose", pose_json(*frame.head)}});
  return ok_status();
}

}  // namespace nade::io
