#include "mediapipe_result.h"

// Based on: Google. MediaPipe, HandLandmarkerResult and the Hands solution. (the keys and the
// order of the points)

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "mediapipe_keys.h"
#include "recording_limits.h"

namespace nade::io {
namespace {

/// The values of one hand, none where the file has none, and what to call them.
struct HandValues {
  const Json* picture = nullptr;
  const Json* world = nullptr;
  const Json* side = nullptr;
  std::string place;
};

/// The first of the keys that an object has, but for null; none where it has none.
template <std::size_t N>
const Json* value_under(const Json& object, const std::array<std::string_view, N>& keys) {
  for (const std::string_view key : keys) {
    const auto found = object.find(std::string(key));
    if (found != object.end() && !found->is_null()) return &*found;
  }
  return nullptr;
}

/// What Python's protocol buffers put around a list.
const Json& unwrapped(const Json& value) {
  if (!value.is_object()) return value;
  const Json* const inner = value_under(
      value,
      std::array<std::string_view, 4>{"landmark", "landmarks", "classification", "categories"});
  return inner == nullptr ? value : *inner;
}

bool is_point(const Json& value) {
  return value.is_object() ? value.contains("x")
                           : value.is_array() && !value.empty() && !value[0].is_structured();
}

/// The hands in what stands under a key: a list of hands, or the points of one.
std::vector<const Json*> listed(const Json* value) {
  std::vector<const Json*> hands;
  if (value == nullptr) return hands;
  const Json& list = unwrapped(*value);
  if (list.is_array() && !list.empty() && is_point(list[0])) return {&list};
  if (!list.is_array()) return {&list};
  for (const Json& hand : list) hands.push_back(&unwrapped(hand));
  return hands;
}

std::optional<double> coordinate_of(const Json& point, const char* key, std::size_t index) {
  const Json* value = nullptr;
  if (point.is_array()) {
    if (index < point.size()) value = &point[index];
  } else if (const auto found = point.find(key); found != point.end()) {
    value = &*found;
  }
  if (value == nullptr || !value->is_number()) return std::nullopt;
  const double number = value->get<double>();
  if (!(std::abs(number) <= kFarthest_m)) return std::nullopt;
  return number;
}

/// None where a number is missing or not finite.
Result<std::optional<Landmarks>> landmarks_of(const Json& list, const std::string& place) {
  if (list.is_null()) return std::optional<Landmarks>();
  if (!list.is_array() || list.size() != kLandmarkCount) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: expected {} points of a hand, found {}", place, kLandmarkCount,
                             list.is_array() ? std::to_string(list.size()) : kind_of(list))};
  }
  Landmarks landmarks;
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    if (!list[i].is_structured()) return std::optional<Landmarks>();
    const auto x = coordinate_of(list[i], "x", 0);
    const auto y = coordinate_of(list[i], "y", 1);
    const auto z = coordinate_of(list[i], "z", 2);
    if (!x || !y || !z) return std::optional<Landmarks>();
    landmarks[i] = {*x, *y, *z};
  }
  return std::optional<Landmarks>(landmarks);
}

std::optional<Handedness> side_in(const std::string& text) {
  if (text == "Left" || text == "left" || text == "LEFT") return Handedness::left;
  if (text == "Right" || text == "right" || text == "RIGHT") return Handedness::right;
  return std::nullopt;
}

/// Reads the first of the categories that a classifier gives, or a bare word.
Status read_side(const Json* value, const std::string& place, LandmarkHand& hand) {
  const Json* category = value == nullptr ? nullptr : &unwrapped(*value);
  while (category != nullptr && category->is_array()) {
    category = category->empty() ? nullptr : &unwrapped((*category)[0]);
  }
  const Json* const name =
      category == nullptr || !category->is_object()
          ? category
          : value_under(*category,
                        std::array<std::string_view, 5>{"categoryName", "category_name", "label",
                                                        "displayName", "display_name"});
  const std::optional<Handedness> side =
      name == nullptr || !name->is_string() ? std::nullopt : side_in(name->get<std::string>());
  if (!side) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: expected the hand's side, \"Left\" or \"Right\", found {}", place,
                             name == nullptr ? "none" : name->dump())};
  }
  hand.side = *side;
  if (category->is_object() && category->contains("score") && (*category)["score"].is_number()) {
    hand.score = std::clamp((*category)["score"].get<double>(), 0.0, 1.0);
  }
  return ok_status();
}

/// None where the points cannot be used, which is a warning.
Result<std::optional<LandmarkHand>> read_landmark_hand(const HandValues& values,
                                                       Warnings& warnings) {
  LandmarkHand hand;
  const Status side = read_side(values.side, values.place, hand);
  if (!side) return side.error();
  bool usable = true;
  for (const auto& [list, landmarks] :
       {std::pair(values.picture, &hand.picture), std::pair(values.world, &hand.world)}) {
    if (list == nullptr) continue;
    Result<std::optional<Landmarks>> read = landmarks_of(*list, values.place);
    if (!read) return read.error();
    *landmarks = *read;
    usable = usable && landmarks->has_value();
  }
  if (usable) return std::optional<LandmarkHand>(hand);
  warnings.add(Oddity::unusable_hand,
               fmt::format("{}: {}: a point is missing or not finite; the hand is left out of the "
                           "frame",
                           values.place, name_of(hand.side)));
  return std::optional<LandmarkHand>();
}

/// The hands of a frame that lists points, points of the world and sides apart.
Result<std::vector<HandValues>> hands_in_lists(const Json& frame, const std::string& place) {
  const std::vector<const Json*> pictures = listed(value_under(frame, kPictureKeys));
  const std::vector<const Json*> worlds = listed(value_under(frame, kWorldKeys));
  const Json* const sides = value_under(frame, kSidesKeys);
  const std::size_t count = std::max(pictures.size(), worlds.size());
  const bool sides_listed = sides != nullptr && sides->is_array();
  if (!pictures.empty() && !worlds.empty() && pictures.size() != worlds.size()) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: expected as many hands in the picture as in the world, found {} "
                             "and {}",
                             place, pictures.size(), worlds.size())};
  }
  std::vector<HandValues> hands;
  for (std::size_t i = 0; i < count; ++i) {
    HandValues values;
    if (!pictures.empty()) values.picture = pictures[i];
    if (!worlds.empty()) values.world = worlds[i];
    if (sides_listed && i < sides->size()) values.side = &(*sides)[i];
    if (!sides_listed && count == 1) values.side = sides;
    values.place = fmt::format("{}: hand {}", place, i);
    hands.push_back(std::move(values));
  }
  return hands;
}

/// The hands of a frame that has an object for each.
std::vector<HandValues> hands_in_objects(const Json& objects, const std::string& place) {
  std::vector<HandValues> hands;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (!objects[i].is_object()) continue;
    const auto points = [&](const auto& keys) {
      const Json* const value = value_under(objects[i], keys);
      return value == nullptr ? nullptr : &unwrapped(*value);
    };
    hands.push_back({points(kPictureKeys), points(kWorldKeys), value_under(objects[i], kSideKeys),
                     fmt::format("{}: hands[{}]", place, i)});
  }
  return hands;
}

}  // namespace

Result<LandmarkHands> hands_of_result(const Json& frame, const std::string& place,
                                      Warnings& warnings) {
  const auto objects = frame.find("hands");
  Result<std::vector<HandValues>> found =
      objects != frame.end() && objects->is_array()
          ? Result<std::vector<HandValues>>(hands_in_objects(*objects, place))
          : hands_in_lists(frame, place);
  if (!found) return found.error();
  LandmarkHands hands;
  for (const HandValues& values : *found) {
    Result<std::optional<LandmarkHand>> hand = read_landmark_hand(values, warnings);
    if (!hand) return hand.error();
    if (!*hand || (!(*hand)->picture && !(*hand)->world)) continue;
    std::optional<LandmarkHand>& place_in_frame = hands[index_of((*hand)->side)];
    if (place_in_frame) {
      warnings.add(Oddity::hand_twice,
                   fmt::format("{}: two {} hands; the one of less confidence is left out", place,
                               name_of((*hand)->side)));
      if (place_in_frame->score >= (*hand)->score) continue;
    }
    place_in_frame = **hand;
  }
  return hands;
}

std::optional<double> aspect_of_picture(const Json& object) {
  using Names = std::array<std::string_view, 7>;
  const Json* const width =
      value_under(object, Names{"width", "imageWidth", "image_width", "videoWidth", "video_width",
                                "frameWidth", "frame_width"});
  const Json* const height =
      value_under(object, Names{"height", "imageHeight", "image_height", "videoHeight",
                                "video_height", "frameHeight", "frame_height"});
  if (width == nullptr || height == nullptr || !width->is_number() || !height->is_number()) {
    return std::nullopt;
  }
  const double aspect = width->get<double>() / height->get<double>();
  // A picture is not a line.
  if (!(aspect > 0.01 && aspect < 100.0)) return std::nullopt;
  return aspect;
}

}  // namespace nade::io
