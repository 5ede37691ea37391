#include "bids_motion.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "json_reader.h"
#include "nade/io/output_file.h"
#include "nade/io/recording.h"

// Based on: S. Jeung et al. Motion-BIDS: an extension to the brain imaging data structure to
// organize motion data for reproducible research. Scientific Data, 2024. (BIDS 1.9, "Motion")

namespace nade::study {
namespace {

constexpr std::array<const char*, 7> kComponents{"x",      "y",      "z",     "quat_x",
                                                 "quat_y", "quat_z", "quat_w"};
constexpr std::size_t kPositions = 3;
constexpr std::string_view kMissing = "n/a";

/// What a recording has, from a first reading.
struct Overview {
  std::size_t frames = 0;
  double length_s = 0.0;
  std::array<bool, 2> hands{};
  bool head = false;
  std::string source;
};

template <class Action>
Status for_each_frame(const std::string& path, Action&& action) {
  Result<RecordingReader> reader = RecordingReader::open(path);
  if (!reader) return reader.error();
  while (true) {
    const Result<std::optional<RecordedFrame>> frame = reader->next();
    if (!frame) return frame.error();
    if (!*frame) return ok_status();
    const Status done = action(**frame, reader->header());
    if (!done) return done;
  }
}

Result<Overview> overview_of(const std::string& path) {
  Overview overview;
  const Status read =
      for_each_frame(path, [&](const RecordedFrame& frame, const RecordingHeader& header) {
        overview.source = header.source;
        ++overview.frames;
        overview.length_s = 1e-9 * static_cast<double>(frame.time_ns);
        for (std::size_t side = 0; side < 2; ++side) {
          overview.hands[side] = overview.hands[side] || frame.hands[side].has_value();
        }
        overview.head = overview.head || frame.head.has_value();
        return ok_status();
      });
  if (!read) return read.error();
  return overview;
}

void append_pose(fmt::memory_buffer& row, const Pose* pose) {
  std::array<double, kComponents.size()> numbers{};
  if (pose != nullptr) {
    const Vec3& at = pose->position;
    const Quat& turn = pose->rotation;
    numbers = {at.x(), at.y(), at.z(), turn.x(), turn.y(), turn.z(), turn.w()};
  }
  for (const double number : numbers) {
    fmt::format_to(fmt::appender(row), "\t");
    if (pose == nullptr) {
      fmt::format_to(fmt::appender(row), "{}", kMissing);
    } else {
      fmt::format_to(fmt::appender(row), "{}", number);
    }
  }
}

/// The points of one tracking system, in the order of their channels.
struct System {
  std::string name;  ///< "hand"
  std::string description;
  std::vector<std::string> points;
};

/// Writes one tracking system's four files.
class SystemWriter {
 public:
  SystemWriter(const BidsMotion& motion, const Overview& overview, System system)
      : motion_(motion), overview_(overview), system_(std::move(system)) {}

  [[nodiscard]] std::string path(std::string_view suffix) const {
    return fmt::format("{}/{}_{}", motion_.folder, name(), suffix);
  }
  [[nodiscard]] std::string name() const {
    return fmt::format("{}_tracksys-{}{}", motion_.stem, system_.name, motion_.run);
  }

  Status write_descriptions() const {
    const Status channels = write_whole(path("channels.tsv"), channels_table());
    if (!channels) return channels;
    const Json frames{{"reference_frame",
                       {{"Description", "The frame in which positions and orientations are given."},
                        {"Levels",
                         {{"global",
                           {{"SpatialAxes", "RSP"},
                            {"RotationRule", "right-hand"},
                            {"Description",
                             "Right-handed, x to the right, y up, z backward, as seen by the "
                             "participant."}}}}}}}};
    const Status frame = write_whole(path("channels.json"), frames.dump(2) + "\n");
    if (!frame) return frame;
    return write_whole(path("motion.json"), sidecar().dump(2) + "\n");
  }

 private:
  [[nodiscard]] std::string channels_table() const {
    std::string table = "name\tcomponent\ttype\ttracked_point\tunits\treference_frame\n";
    table += "latency\tn/a\tLATENCY\tn/a\ts\tn/a\n";
    for (const std::string& point : system_.points) {
      for (std::size_t i = 0; i < kComponents.size(); ++i) {
        const bool position = i < kPositions;
        table +=
            fmt::format("{}_{}\t{}\t{}\t{}\t{}\tglobal\n", point, kComponents[i], kComponents[i],
                        position ? "POS" : "ORNT", point, position ? "m" : "n/a");
      }
    }
    return table;
  }

  [[nodiscard]] Json sidecar() const {
    const std::size_t points = system_.points.size();
    const double rate = overview_.length_s > 0.0
                            ? static_cast<double>(overview_.frames - 1) / overview_.length_s
                            : 0.0;
    Json json{{"TaskName", "stroking"}};
    json.update(Json::parse(motion_.about_json));
    json["TrackingSystemName"] = fmt::format("{} ({})", system_.description, overview_.source);
    json["SamplingFrequency"] = std::round(rate);
    json["SamplingFrequencyEffective"] = rate;
    json["RecordingDuration"] = overview_.length_s;
    json["MissingValues"] = kMissing;
    json["TrackedPointsCount"] = points;
    json["MotionChannelCount"] = 1 + points * kComponents.size();
    json["LATENCYChannelCount"] = 1;
    json["POSChannelCount"] = points * kPositions;
    json["ORNTChannelCount"] = points * (kComponents.size() - kPositions);
    return json;
  }

  const BidsMotion& motion_;
  const Overview& overview_;
  System system_;
};

System hand_system(const Overview& overview) {
  System system{"hand", "Hand tracking", {}};
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    if (!overview.hands[index_of(side)]) continue;
    for (std::size_t joint = 0; joint < kJointCount; ++joint) {
      system.points.push_back(fmt::format("{}_{}", name_of(side), nade::name_of(joint_at(joint))));
    }
  }
  return system;
}

void append_hands(fmt::memory_buffer& row, const RecordedFrame& frame, const Overview& overview) {
  for (std::size_t side = 0; side < 2; ++side) {
    if (!overview.hands[side]) continue;
    for (std::size_t joint = 0; joint < kJointCount; ++joint) {
      append_pose(row, frame.hands[side] ? &frame.hands[side]->pose.joints[joint] : nullptr);
    }
  }
}

}  // namespace

Result<std::vector<std::string>> write_bids_motion(const BidsMotion& motion) {
  const Result<Overview> overview = overview_of(motion.recording);
  if (!overview) return overview.error();
  const bool with_head = motion.with_head && overview->head;
  const SystemWriter hands(motion, *overview, hand_system(*overview));
  const SystemWriter head(motion, *overview, {"head", "Head tracking", {"head"}});
  const Status described = hands.write_descriptions();
  if (!described) return described.error();
  if (with_head) {
    const Status head_described = head.write_descriptions();
    if (!head_described) return head_described.error();
  }
  constexpr auto kPlain = OutputFile::Encoding::plain;
  Result<OutputFile> hand_file = OutputFile::create(hands.path("motion.tsv"), kPlain);
  if (!hand_file) return hand_file.error();
  std::optional<OutputFile> head_file;
  if (with_head) {
    Result<OutputFile> created = OutputFile::create(head.path("motion.tsv"), kPlain);
    if (!created) return created.error();
    head_file.emplace(std::move(created).value());
  }
  fmt::memory_buffer row;
  const auto end_row = [&](OutputFile& file) {
    fmt::format_to(fmt::appender(row), "\n");
    return file.write({row.data(), row.size()});
  };
  const auto begin_row = [&](const RecordedFrame& frame) {
    row.clear();
    fmt::format_to(fmt::appender(row), "{:.6f}", 1e-9 * static_cast<double>(frame.time_ns));
  };
  const Status written = for_each_frame(
      motion.recording, [&](const RecordedFrame& frame, const RecordingHeader&) -> Status {
        begin_row(frame);
        append_hands(row, frame, *overview);
        const Status hand_written = end_row(*hand_file);
        if (!hand_written || !head_file) return hand_written;
        begin_row(frame);
        append_pose(row, frame.head ? &*frame.head : nullptr);
        return end_row(*head_file);
      });
  if (!written) return written.error();
  const Status finished = hand_file->finish();
  if (!finished) return finished.error();
  std::vector<std::string> names{fmt::format("motion/{}_motion.tsv", hands.name())};
  if (!head_file) return names;
  const Status head_finished = head_file->finish();
  if (!head_finished) return head_finished.error();
  names.push_back(fmt::format("motion/{}_motion.tsv", head.name()));
  return names;
}

}  // namespace nade::study
