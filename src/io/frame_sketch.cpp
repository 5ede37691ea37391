#include "frame_sketch.h"

#include <algorithm>

#include "mediapipe_keys.h"
#include "sketch_reader.h"

namespace nade::io {
namespace {

/// More than any frame or hand has; a text of nothing but keys would take long.
constexpr std::size_t kMostKeys = 64;

void note_key(const std::string& key, SketchReader& reader, Sketch& sketch) {
  if (sketch.members.size() < kMostKeys && sketch.find(key) == nullptr) {
    sketch.members.push_back({key, reader.begins()});
  }
}

/// Calls `take` at the value of each member of the object that the reader stands at; it steps past
/// the value.
template <class Take>
void walk_object(SketchReader& reader, Take&& take) {
  if (!reader.step('{')) return;
  do {
    const std::string key = reader.string();
    if (!reader.step(':')) return;
    static_cast<void>(reader.at_end());
    take(key);
  } while (reader.step(','));
  static_cast<void>(reader.step('}'));
}

/// The same of each element of an array.
template <class Take>
void walk_array(SketchReader& reader, Take&& take) {
  if (!reader.step('[')) return;
  do {
    take();
  } while (reader.step(','));
  static_cast<void>(reader.step(']'));
}

void sketch_hand(SketchReader& reader, Sketch& hand) {
  if (!reader.begins().starts_with('{')) return reader.skip_value();
  walk_object(reader, [&](const std::string& key) {
    note_key(key, reader, hand);
    reader.skip_value();
  });
}

void sketch_hands(SketchReader& reader, Sketch& hand) {
  const std::string begins = reader.begins();
  if (begins.starts_with('[')) {
    walk_array(reader, [&] { sketch_hand(reader, hand); });
  } else if (begins.starts_with('{')) {
    walk_object(reader, [&](const std::string&) { sketch_hand(reader, hand); });
  } else {
    reader.skip_value();
  }
}

/// One member of a frame.
void sketch_member(const std::string& key, SketchReader& reader, FrameSketch& sketch) {
  note_key(key, reader, sketch.frame);
  if (key == "hands") return sketch_hands(reader, sketch.hand);
  if (key == "left" || key == "right") return sketch_hand(reader, sketch.hand);
  reader.skip_value();
}

void sketch_frames(SketchReader& reader, FrameSketch& sketch) {
  walk_array(reader, [&] {
    if (!reader.begins().starts_with('{')) return reader.skip_value();
    walk_object(reader, [&](const std::string& key) { sketch_member(key, reader, sketch); });
  });
}

}  // namespace

FrameSketch frame_sketch_of(std::string_view text) {
  FrameSketch sketch;
  SketchReader reader(text);
  if (reader.begins().starts_with('[')) {
    sketch_frames(reader, sketch);
    return sketch;
  }
  bool in_frames = false;
  while (!in_frames && reader.begins().starts_with('{')) {
    walk_object(reader, [&](const std::string& key) {
      in_frames = in_frames || (key == "frames" && reader.begins().starts_with('['));
      if (key == "frames") {
        // What stood before the frames is none of theirs.
        sketch = {};
        sketch_frames(reader, sketch);
      } else if (in_frames) {
        reader.skip_value();
      } else {
        sketch_member(key, reader, sketch);
      }
    });
  }
  return sketch;
}

bool FrameSketch::has_landmarks() const {
  const auto any = [](const Sketch& sketch) {
    return std::any_of(sketch.members.begin(), sketch.members.end(),
                       [](const Sketch::Member& member) { return is_landmark_key(member.key); });
  };
  return any(frame) || any(hand);
}

bool FrameSketch::has_webxr_joints() const {
  if (frame.find("pointables") != nullptr) return false;
  const Sketch::Member* const joints = hand.find("joints");
  // Numbers in arrays are our own frames.
  if (joints != nullptr && joints->begins.starts_with("[[")) return false;
  const Sketch::Member* const hands = frame.find("hands");
  return frame.find("left") != nullptr || frame.find("right") != nullptr ||
         (hands != nullptr && hands->begins.starts_with('{')) ||
         hand.find("handedness") != nullptr || hand.find("wrist") != nullptr;
}

}  // namespace nade::io
