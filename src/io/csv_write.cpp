#include "csv_write.h"

#include <array>
#include <string_view>
#include <utility>

#include "csv_columns.h"
#include "recording_names.h"

namespace nade::io {
namespace {

constexpr std::array<std::string_view, 7> kContactNames{"px", "py", "pz",   "nx",
                                                        "ny", "nz", "depth"};

template <class... Values>
void append(fmt::memory_buffer& out, fmt::format_string<Values...> form, Values&&... values) {
  fmt::format_to(fmt::appender(out), form, std::forward<Values>(values)...);
}

}  // namespace

bool names_a_table(const std::string& path) { return content_ending_of(path) == ".csv"; }

void append_csv_names(fmt::memory_buffer& out) {
  append(out, "time_ns,hand,status,confidence");
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    for (const std::string_view number : kJointNumberNames) {
      append(out, ",{}_{}", name_of(joint_at(joint)), number);
    }
  }
  for (std::size_t part = 0; part < kPartCount; ++part) {
    for (const std::string_view number : kContactNames) {
      append(out, ",contact_{}_{}", name_of(part_at(part)), number);
    }
  }
  append(out, "\n");
}

void append_csv_frame(const RecordedFrame& frame, fmt::memory_buffer& out) {
  for (const std::optional<RecordedHand>& hand : frame.hands) {
    if (!hand) continue;
    append(out, "{},{},{},{}", frame.time_ns, name_of(hand->pose.side),
           hand->status ? kStatusNames[static_cast<std::size_t>(*hand->status)] : "",
           hand->pose.confidence);
    for (std::size_t joint = 0; joint < kJointCount; ++joint) {
      const Vec3& at = hand->pose.joints[joint].position;
      const Quat& turn = hand->pose.joints[joint].rotation;
      append(out, ",{},{},{},{},{},{},{},{}", at.x(), at.y(), at.z(), turn.x(), turn.y(), turn.z(),
             turn.w(), hand->pose.radius[joint]);
    }
    for (const std::optional<RecordedContact>& contact : hand->contact) {
      if (!contact) {
        append(out, ",,,,,,,");
        continue;
      }
      const Vec3& at = contact->point;
      const Vec3& normal = contact->normal;
      append(out, ",{},{},{},{},{},{},{}", at.x(), at.y(), at.z(), normal.x(), normal.y(),
             normal.z(), contact->depth_m);
    }
    append(out, "\n");
  }
}

}  // namespace nade::io
