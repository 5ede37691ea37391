#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "nade/eval/scene.h"
#include "nade/eval/shapes.h"

namespace nade {
namespace {

using Json = nlohmann::json;

constexpr double kSceneReach_m = 5.0;
constexpr double kLongest_s = 60.0;
constexpr std::size_t kMostTimes = 1000;
constexpr std::size_t kMostParts = 200;

/// Reads elements, and keeps the first thing that is wrong with one.
class SceneReader {
 public:
  explicit SceneReader(const std::string& file) : file_(file) {}

  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

  void read(const Json& json, BenchScene& scene);

 private:
  void fail(const std::string& where, const std::string& expected) {
    if (error_) return;
    error_ =
        Error{ErrorCode::bad_format, fmt::format("{}: {}: expected {}", file_, where, expected)};
  }
  void check_keys(const Json& json, const std::string& where,
                  std::initializer_list<const char*> known);
  double number(const Json& json, const std::string& where, double low, double high);
  double number(const Json& json, const std::string& where, const char* key, double low,
                double high, double otherwise);
  std::string text(const Json& json, const char* key, const std::string& otherwise);
  Vec3 vector(const Json& json, const std::string& where, double low, double high);
  Vec3 vector(const Json& json, const std::string& where, const char* key, double low, double high,
              const Vec3& otherwise);
  Gesture gesture(const Json& json, const std::string& where);
  std::optional<Bend> bend(const Json& json, const std::string& where);
  std::variant<SceneAnchor, Joint> anchor(const Json& json, const std::string& where);
  void object(const Json& json, BenchScene& scene);
  void part(const Json& json, const std::string& where, TriangleSoup& soup);
  TriangleSoup shape(const Json& json, const std::string& where);
  void path(const Json& json, BenchScene& scene);
  void motion(const Json& json, BenchScene& scene);
  void faults(const Json& json, BenchScene& scene);
  void who(const Json& json, BenchScene& scene);
  template <class Key>
  void add(const Json& json, const std::string& where, const Key& key, std::vector<Key>& keys);
  template <class Key>
  void repeat(const Json& json, const std::string& where, std::vector<Key>& keys);

  std::string file_;
  std::optional<Error> error_;
};

std::string element(const std::string& list, std::size_t index) {
  return fmt::format("{}[{}]", list, index);
}

void SceneReader::check_keys(const Json& json, const std::string& where,
                             std::initializer_list<const char*> known) {
  if (!json.is_object()) return fail(where, "an object");
  for (const auto& [key, value] : json.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      return fail(where, fmt::format("no key '{}'", key));
    }
  }
}

double SceneReader::number(const Json& json, const std::string& where, double low, double high) {
  if (json.is_number()) {
    const auto value = json.get<double>();
    if (value >= low && value <= high) return value;
  }
  fail(where, fmt::format("a number from {:g} to {:g}", low, high));
  return low;
}

double SceneReader::number(const Json& json, const std::string& where, const char* key, double low,
                           double high, double otherwise) {
  const auto found = json.find(key);
  return found == json.end() ? otherwise : number(*found, where + "." + key, low, high);
}

std::string SceneReader::text(const Json& json, const char* key, const std::string& otherwise) {
  const auto found = json.find(key);
  if (found == json.end()) return otherwise;
  if (found->is_string()) return found->get<std::string>();
  fail(key, "text");
  return otherwise;
}

Vec3 SceneReader::vector(const Json& json, const std::string& where, double low, double high) {
  if (!json.is_array() || json.size() != 3) {
    fail(where, "three numbers");
    return Vec3::Zero();
  }
  return {number(json[0], where, low, high), number(json[1], where, low, high),
          number(json[2], where, low, high)};
}

Vec3 SceneReader::vector(const Json& json, const std::string& where, const char* key, double low,
                         double high, const Vec3& otherwise) {
  const auto found = json.find(key);
  return found == json.end() ? otherwise : vector(*found, where + "." + key, low, high);
}

std::optional<Bend> SceneReader::bend(const Json& json, const std::string& where) {
  if (!json.is_array() || json.size() < 3 || json.size() > 4) {
    fail(where, "three or four angles, degrees");
    return std::nullopt;
  }
  const auto angle = [&](std::size_t i) { return kDegree * number(json[i], where, -90.0, 120.0); };
  Bend bend{angle(0), angle(1), angle(2)};
  if (json.size() == 4) bend.abduction = angle(3);
  return bend;
}

Gesture SceneReader::gesture(const Json& json, const std::string& where) {
  const std::optional<Gesture> named =
      json.is_string() ? gesture_from_name(json.get<std::string>()) : std::nullopt;
  if (named) return *named;
  if (!json.is_object()) {
    fail(where, "bends of digits, or one of " + gesture_names());
    return {};
  }
  check_keys(json, where, {"thumb", "index", "middle", "ring", "little"});
  Gesture gesture;
  for (std::size_t i = 0; i < kDigitCount; ++i) {
    const std::string digit(name_of(part_of(digit_at(i))));
    std::string place = where;
    place.append(".").append(digit);
    if (const auto found = json.find(digit); found != json.end()) {
      gesture[i] = bend(*found, place);
    }
  }
  return gesture;
}

std::variant<SceneAnchor, Joint> SceneReader::anchor(const Json& json, const std::string& where) {
  const std::string name = json.is_string() ? json.get<std::string>() : std::string();
  if (name == "palm") return SceneAnchor::palm;
  if (name == "lowest") return SceneAnchor::lowest;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    if (name_of(joint_at(i)) == name) return joint_at(i);
  }
  fail(where, "palm, lowest or a joint's name");
  return SceneAnchor::palm;
}

TriangleSoup SceneReader::shape(const Json& json, const std::string& where) {
  if (json.contains("box")) {
    return box_soup(0.5 * vector(json["box"], where + ".box", 1e-4, kSceneReach_m));
  }
  if (json.contains("ball")) {
    return capsule_soup(number(json["ball"], where + ".ball", 1e-3, kSceneReach_m), 0.0);
  }
  const auto pair = [&](const char* key) -> std::array<double, 3> {
    const Vec3 numbers = vector(json[key], where + "." + key, 0.0, kSceneReach_m);
    return {std::max(numbers.x(), 1e-3), std::max(numbers.y(), 1e-3), numbers.z()};
  };
  if (json.contains("rod")) {
    const Json& sizes = json["rod"];
    if (sizes.is_array() && sizes.size() == 2) {
      return capsule_soup(number(sizes[0], where + ".rod", 1e-3, kSceneReach_m),
                          number(sizes[1], where + ".rod", 0.0, kSceneReach_m));
    }
    fail(where + ".rod", "a radius and a length");
  } else if (json.contains("cup")) {
    const auto [radius_m, height_m, wall_m] = pair("cup");
    if (wall_m > 0.0 && wall_m < std::min(radius_m, height_m)) {
      return cup_soup(radius_m, height_m, wall_m);
    }
    fail(where + ".cup", "a radius, a height and a wall thinner than both");
  } else {
    fail(where, "box, ball, rod or cup");
  }
  return {};
}

void SceneReader::part(const Json& json, const std::string& where, TriangleSoup& soup) {
  check_keys(json, where, {"box", "ball", "rod", "cup", "at", "turn", "count", "step"});
  if (error_) return;
  const TriangleSoup one = shape(json, where);
  const Vec3 at = vector(json, where, "at", -kSceneReach_m, kSceneReach_m, Vec3::Zero());
  const Vec3 step = vector(json, where, "step", -kSceneReach_m, kSceneReach_m, Vec3::Zero());
  const Vec3 turn = kDegree * vector(json, where, "turn", -360.0, 360.0, Vec3::Zero());
  const auto count = static_cast<int>(number(json, where, "count", 1.0, kMostParts, 1.0));
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    const Pose pose{at + i * step, turned_by(turn)};
    for (const Eigen::Vector3f& vertex : one.vertices) {
      soup.vertices.emplace_back(pose.apply(vertex.cast<double>()).cast<float>());
    }
    for (const auto& [a, b, c] : one.triangles) {
      soup.triangles.push_back({first + a, first + b, first + c});
    }
  }
}

void SceneReader::object(const Json& json, BenchScene& scene) {
  if (json.is_string()) {
    scene.object = json.get<std::string>();
  } else if (json.is_array() && !json.empty() && json.size() <= kMostParts) {
    for (std::size_t i = 0; i < json.size() && !error_; ++i) {
      part(json[i], element("object", i), scene.soup);
    }
  } else {
    fail("object", "a name, or a list of parts");
  }
}

/// Times increase from 0.
template <class Key>
void SceneReader::add(const Json& json, const std::string& where, const Key& key,
                      std::vector<Key>& keys) {
  const bool fits =
      json.contains("t") && (keys.empty() ? key.time_s == 0.0 : key.time_s > keys.back().time_s);
  if (!fits) return fail(where + ".t", "times that begin at 0 and increase");
  keys.push_back(key);
}

/// The keys after `from`, up to this one, several times.
template <class Key>
void SceneReader::repeat(const Json& json, const std::string& where, std::vector<Key>& keys) {
  const double from_s = number(json, where, "from", 0.0, kLongest_s, 0.0);
  const auto times = static_cast<int>(number(json, where, "repeat", 1.0, kMostTimes, 1.0));
  const double length_s = keys.empty() ? 0.0 : keys.back().time_s - from_s;
  if (!(length_s > 0.0)) return fail(where + ".from", "a time before the key that repeats");
  const std::vector<Key> cycle = keys;
  for (int i = 1; i < times; ++i) {
    for (Key key : cycle) {
      if (key.time_s <= from_s) continue;
      key.time_s += i * length_s;
      keys.push_back(key);
    }
  }
}

void SceneReader::path(const Json& json, BenchScene& scene) {
  if (!json.is_array() || json.empty()) return fail("path", "a list of keys");
  SceneKey key;
  for (std::size_t i = 0; i < json.size() && !error_; ++i) {
    const Json& one = json[i];
    const std::string where = element("path", i);
    check_keys(one, where, {"t", "at", "of", "turn", "gesture", "from", "repeat"});
    if (error_) return;
    key.time_s = number(one, where, "t", 0.0, kLongest_s, -1.0);
    key.at = vector(one, where, "at", -kSceneReach_m, kSceneReach_m, key.at);
    key.turn_rad = kDegree * vector(one, where, "turn", -720.0, 720.0, key.turn_rad / kDegree);
    if (one.contains("of")) key.anchor = anchor(one["of"], where + ".of");
    if (one.contains("gesture")) key.gesture = gesture(one["gesture"], where + ".gesture");
    add(one, where, key, scene.path);
    if (!error_ && one.contains("repeat")) repeat(one, where, scene.path);
  }
}

void SceneReader::motion(const Json& json, BenchScene& scene) {
  if (!json.is_array()) return fail("motion", "a list of keys");
  SceneMotionKey key;
  for (std::size_t i = 0; i < json.size() && !error_; ++i) {
    const Json& one = json[i];
    const std::string where = element("motion", i);
    check_keys(one, where, {"t", "at", "turn", "stretch", "from", "repeat"});
    if (error_) return;
    key.time_s = number(one, where, "t", 0.0, kLongest_s, -1.0);
    key.at = vector(one, where, "at", -kSceneReach_m, kSceneReach_m, key.at);
    key.turn_rad = kDegree * vector(one, where, "turn", -720.0, 720.0, key.turn_rad / kDegree);
    key.stretch = vector(one, where, "stretch", 0.1, 10.0, key.stretch);
    if (scene.soup.vertices.empty() && key.stretch != Vec3::Ones()) {
      return fail(where + ".stretch", "an object made of parts");
    }
    add(one, where, key, scene.motion);
    if (!error_ && one.contains("repeat")) repeat(one, where, scene.motion);
  }
}

void SceneReader::faults(const Json& json, BenchScene& scene) {
  if (!json.is_array()) return fail("faults", "a list");
  for (std::size_t i = 0; i < json.size() && !error_; ++i) {
    const Json& one = json[i];
    const std::string where = element("faults", i);
    check_keys(one, where, {"t", "lost_ms", "swapped_ms", "glitch_frames", "shift", "turn"});
    if (error_) return;
    const double time_s = number(one, where, "t", 0.0, kLongest_s, 0.0);
    if (one.contains("lost_ms")) {
      scene.faults.push_back(
          SceneLoss{time_s, 1e-3 * number(one["lost_ms"], where, 1.0, 1e3 * kLongest_s)});
    } else if (one.contains("swapped_ms")) {
      scene.faults.push_back(
          SceneSwap{time_s, 1e-3 * number(one["swapped_ms"], where, 1.0, 1e3 * kLongest_s)});
    } else if (one.contains("glitch_frames")) {
      const auto frames =
          static_cast<std::size_t>(number(one["glitch_frames"], where, 1.0, kMostTimes));
      const Vec3 shift = vector(one, where, "shift", -kSceneReach_m, kSceneReach_m, Vec3::Zero());
      const Vec3 turn = kDegree * vector(one, where, "turn", -360.0, 360.0, Vec3::Zero());
      scene.faults.push_back(SceneGlitch{time_s, frames, {shift, turned_by(turn)}});
    } else {
      fail(where, "lost_ms, swapped_ms or glitch_frames");
    }
  }
}

void SceneReader::who(const Json& json, BenchScene& scene) {
  const std::string hand = text(json, "hand", "right");
  if (hand != "right" && hand != "left" && hand != "both") fail("hand", "right, left or both");
  scene.hands = {hand != "right", hand != "left"};
  scene.hand_scale = number(json, "scene", "size", 0.3, 3.0, 1.0);
  scene.rate_hz = number(json, "scene", "rate", 5.0, 1000.0, 90.0);
  const auto noise = noise_from_name(text(json, "noise", "none"));
  if (!noise) fail("noise", "none, quest or leap");
  scene.noise = noise.value_or(NoiseModel::none);
  scene.seed = static_cast<std::uint64_t>(number(json, "scene", "seed", 1.0, 1e9, 1.0));
}

void SceneReader::read(const Json& json, BenchScene& scene) {
  check_keys(json, "scene",
             {"what", "object", "place", "hand", "size", "rate", "noise", "seed", "path", "motion",
              "faults", "depth"});
  if (error_) return;
  scene.what = text(json, "what", "");
  scene.place = text(json, "place", "");
  who(json, scene);
  object(json.contains("object") ? json["object"] : Json(), scene);
  path(json.contains("path") ? json["path"] : Json(), scene);
  if (json.contains("motion")) motion(json["motion"], scene);
  if (json.contains("faults")) faults(json["faults"], scene);
  const auto depth = json.find("depth");
  if (depth == json.end() || !depth->is_array() || depth->size() != 2) {
    return fail("depth", "two depths between which the hand's deepest skin is, metres");
  }
  scene.depth_least_m = number((*depth)[0], "depth", 0.0, 1.0);
  scene.depth_most_m = number((*depth)[1], "depth", 0.0, 1.0);
}

}  // namespace

Result<BenchScene> read_scene(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream whole;
  whole << file.rdbuf();
  if (!file) return Error{ErrorCode::not_found, fmt::format("{}: expected a scene", path)};
  const Json json = Json::parse(whole.str(), nullptr, false);
  if (json.is_discarded()) {
    return Error{ErrorCode::bad_format, fmt::format("{}: expected JSON", path)};
  }
  BenchScene scene;
  scene.name = std::filesystem::path(path).stem().string();
  SceneReader reader(path);
  reader.read(json, scene);
  if (reader.error()) return *reader.error();
  return scene;
}

Result<std::vector<std::shared_ptr<const BenchScene>>> read_scenes(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  }
  if (failed || files.empty()) {
    return Error{ErrorCode::not_found, fmt::format("{}: expected a folder of scenes", folder)};
  }
  std::sort(files.begin(), files.end());
  std::vector<std::shared_ptr<const BenchScene>> scenes;
  for (const std::string& file : files) {
    Result<BenchScene> scene = read_scene(file);
    if (!scene) return scene.error();
    scenes.push_back(std::make_shared<const BenchScene>(std::move(scene).value()));
  }
  return scenes;
}

}  // namespace nade
