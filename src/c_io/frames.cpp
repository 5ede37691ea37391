#include <utility>

#include "convert.h"
#include "records.h"

namespace nade::c_abi {
namespace {

constexpr std::uint32_t kKnown = NADE_IO_HAS_LEFT | NADE_IO_HAS_RIGHT | NADE_IO_HAS_HEAD |
                                 NADE_IO_HAS_STATUS | NADE_IO_HAS_CONFIDENCE;

std::uint32_t flag_of(nade_side side) { return 1U << static_cast<unsigned>(side); }

bool has(const nade_io_frame& frame, std::uint32_t what) { return (frame.has & what) != 0; }

/// NADE_OK, with the hand in `recorded`, or what is wrong with it.
nade_status read_hand(const nade_io_frame& frame, nade_side side,
                      std::optional<RecordedHand>& recorded) {
  if (!has(frame, flag_of(side))) return NADE_OK;
  RecordedHand hand;
  hand.pose = hand_from(side, frame.joints[side]);
  const char* const name = side == NADE_LEFT ? "left" : "right";
  if (const std::optional<HandFault> fault = fault_of(hand.pose)) {
    return fail(NADE_ERROR_ARGUMENT, "frame: %s: %s", name, name_of(*fault).data());  // a literal
  }
  if (has(frame, NADE_IO_HAS_CONFIDENCE)) {
    hand.pose.confidence = static_cast<double>(frame.confidence[side]);
  }
  if (has(frame, NADE_IO_HAS_STATUS)) {
    const Arguments checked = Arguments().within(frame.status[side], NADE_HAND_FREE,
                                                 NADE_HAND_UNTRACKED, "frame: status");
    if (!checked.ok()) return checked.status();
    hand.status = static_cast<HandStatus>(frame.status[side]);
  }
  recorded = std::move(hand);
  return NADE_OK;
}

nade_status read_head(const nade_io_frame& frame, std::optional<Pose>& head) {
  if (!has(frame, NADE_IO_HAS_HEAD)) return NADE_OK;
  const Eigen::Vector4d turn =
      Eigen::Map<const Eigen::Vector4f>(frame.head_rotation).cast<double>();
  const Arguments checked = Arguments()
                                .finite(frame.head_rotation, 4, "frame: head_rotation")
                                .finite(frame.head_position, 3, "frame: head_position")
                                .within(turn.norm(), 0.5, 2.0, "frame: length of head_rotation");
  if (!checked.ok()) return checked.status();
  head = Pose{vector_from(frame.head_position), Quat(turn.normalized())};
  return NADE_OK;
}

void put_joints(const RecordedHand& hand, nade_joint* joints) {
  for (std::size_t i = 0; i < kJointCount; ++i) {
    joints[i] = joint_from(hand.pose.joints[i]);
    joints[i].radius = static_cast<float>(hand.pose.radius[i]);
  }
}

}  // namespace

nade_io_frame frame_from(const RecordedFrame& frame) noexcept {
  nade_io_frame result{};
  result.size = sizeof result;
  result.time_ns = frame.time_ns;
  bool all_have_status = true;
  for (const nade_side side : {NADE_LEFT, NADE_RIGHT}) {
    const std::optional<RecordedHand>& hand = frame.hands[static_cast<std::size_t>(side)];
    if (!hand) continue;
    result.has |= flag_of(side) | NADE_IO_HAS_CONFIDENCE;
    put_joints(*hand, result.joints[side]);
    result.confidence[side] = static_cast<float>(hand->pose.confidence);
    if (!hand->status) all_have_status = false;
    if (hand->status) result.status[side] = static_cast<nade_hand_status>(*hand->status);
  }
  if (result.has != 0 && all_have_status) result.has |= NADE_IO_HAS_STATUS;
  if (frame.head) {
    result.has |= NADE_IO_HAS_HEAD;
    const nade_joint head = joint_from(*frame.head);
    std::memcpy(result.head_rotation, head.rotation, sizeof result.head_rotation);
    std::memcpy(result.head_position, head.position, sizeof result.head_position);
  }
  return result;
}

nade_status read_frame(const nade_io_frame& frame, RecordedFrame& recorded) {
  if ((frame.has & ~kKnown) != 0) {
    return fail(NADE_ERROR_ARGUMENT, "frame: has: expected flags of NADE_IO_HAS_, found 0x%x",
                frame.has);
  }
  recorded.time_ns = frame.time_ns;
  for (const nade_side side : {NADE_LEFT, NADE_RIGHT}) {
    const nade_status status =
        read_hand(frame, side, recorded.hands[static_cast<std::size_t>(side)]);
    if (status != NADE_OK) return status;
  }
  return read_head(frame, recorded.head);
}

}  // namespace nade::c_abi
