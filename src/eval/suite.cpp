#include "nade/eval/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <utility>

#include "nade/eval/press.h"
#include "nade/eval/scene.h"
#include "nade/eval/shapes.h"

namespace nade {
namespace {

constexpr double kSpeed_m_per_s = 0.1;
constexpr double kDepth_m = 0.02;
constexpr double kQuickDuration_s = 2.0;
constexpr double kDuration_s = 4.0;
constexpr std::uint64_t kSeed = 20231;  // of the random strokes
constexpr int kRandomNormal = 40;
constexpr int kRandomFull = 200;

/// Where strokes are made, and what that place allows: a hand does not go deeper than the thing
/// is thick, nor there and back on a short way more than a few times a second.
struct StrokePlace {
  std::string object;
  std::string place;
  double depth_max_m = 0.08;
  double speed_max_m_per_s = 1.0;
};

std::vector<StrokePlace> stroke_places(const SuiteOptions& options) {
  std::vector<StrokePlace> places{
      {"plane", ""},
      {"sphere:0.15", ""},
      {"sphere:0.1", "", 0.06},
      {"sphere:0.06", "", 0.03, 0.3},
      {"dog", "back"},
      {"dog", "flank", 0.06},
      {"dog", "head", 0.03, 0.3},
      {"dog", "ear", 0.004, 0.1},
      {"dog", "leg", 0.01, 0.1},
      {"bowl", "bottom"},
      {"board", "top"},
      {"box", "across"},
      {"box", "along"},
  };
  for (const std::string& file : options.mesh_files) places.push_back({file, "", 0.04, 0.3});
  return places;
}

double duration_s(SuiteSize size) {
  return size == SuiteSize::quick ? kQuickDuration_s : kDuration_s;
}

/// The stroke that every other one is a change of.
SuiteCase base_case(const StrokePlace& where, SuiteSize size) {
  SuiteCase base;
  base.object = where.object;
  base.synth.place = where.place;
  base.synth.speed_m_per_s = std::min(kSpeed_m_per_s, where.speed_max_m_per_s);
  base.synth.depth_m = std::min(kDepth_m, where.depth_max_m);
  base.synth.duration_s = duration_s(size);
  return base;
}

/// One thing changed at a time, as far as the place allows it.
std::vector<SuiteCase> variations(const StrokePlace& where, SuiteSize size) {
  const SuiteCase base = base_case(where, size);
  std::vector<SuiteCase> cases;
  const auto add = [&](const auto& change) {
    SuiteCase changed = base;
    change(changed.synth);
    const bool allowed = changed.synth.depth_m <= where.depth_max_m &&
                         changed.synth.speed_m_per_s <= where.speed_max_m_per_s;
    if (allowed) cases.push_back(std::move(changed));
  };
  for (const Stroke stroke : {Stroke::circle, Stroke::zigzag, Stroke::curl, Stroke::press}) {
    add([&](SynthOptions& synth) { synth.stroke = stroke; });
  }
  for (const double speed : {0.03, 0.3, 1.0}) {
    add([&](SynthOptions& synth) { synth.speed_m_per_s = speed; });
  }
  for (const double depth : {0.005, 0.04, 0.08}) {
    add([&](SynthOptions& synth) { synth.depth_m = depth; });
  }
  for (const double tilt : {-30.0, -15.0, 15.0, 30.0}) {
    add([&](SynthOptions& synth) { synth.tilt_rad = tilt * kDegree; });
  }
  for (const NoiseModel noise : {NoiseModel::leap, NoiseModel::quest}) {
    add([&](SynthOptions& synth) { synth.noise = noise; });
  }
  add([&](SynthOptions& synth) { synth.side = Handedness::left; });
  return cases;
}

/// What is hard about the other shapes, beyond their base strokes.
std::vector<SuiteCase> hard_strokes(const std::vector<StrokePlace>& places, SuiteSize size) {
  std::vector<SuiteCase> cases;
  for (const StrokePlace& where : places) {
    const bool shape = where.object == "bowl" || where.object == "board" || where.object == "box" ||
                       where.object == "sphere:0.06";
    if (!shape) continue;
    const auto add = [&](const auto& change) {
      SuiteCase changed = base_case(where, size);
      change(changed.synth);
      changed.synth.depth_m = std::min(changed.synth.depth_m, where.depth_max_m);
      changed.synth.speed_m_per_s = std::min(changed.synth.speed_m_per_s, where.speed_max_m_per_s);
      cases.push_back(std::move(changed));
    };
    add([](SynthOptions& synth) { synth.depth_m = 0.05; });
    add([](SynthOptions& synth) { synth.speed_m_per_s = 0.5; });
    add([](SynthOptions& synth) { synth.stroke = Stroke::circle; });
    add([](SynthOptions& synth) { synth.stroke = Stroke::press; });
  }
  return cases;
}

template <class T, std::size_t count>
const T& one_of(const std::array<T, count>& choices, Random& random) {
  return choices[static_cast<std::size_t>(random.uniform() * static_cast<double>(count))];
}

SuiteCase random_case(std::span<const StrokePlace> places, SuiteSize size, Random& random) {
  constexpr std::array kStrokes{Stroke::line, Stroke::circle, Stroke::zigzag, Stroke::curl,
                                Stroke::press};
  constexpr std::array kSpeeds{0.03, 0.1, 0.3, 1.0};
  constexpr std::array kDepths{0.005, 0.01, 0.02, 0.03, 0.04, 0.08};
  constexpr std::array kTilts{-30.0, -15.0, 0.0, 0.0, 15.0, 30.0};
  constexpr std::array kNoises{NoiseModel::none, NoiseModel::leap, NoiseModel::quest};
  constexpr std::array kScales{0.75, 1.0, 1.0, 1.15};
  const auto at = static_cast<std::size_t>(random.uniform() * static_cast<double>(places.size()));
  const StrokePlace& where = places[at];
  SuiteCase drawn = base_case(where, size);
  SynthOptions& synth = drawn.synth;
  synth.stroke = one_of(kStrokes, random);
  synth.speed_m_per_s = std::min(one_of(kSpeeds, random), where.speed_max_m_per_s);
  synth.depth_m = std::min(one_of(kDepths, random), where.depth_max_m);
  // Pressing is done a few times a second at the most.
  if (synth.stroke == Stroke::press) synth.speed_m_per_s = synth.depth_m < 0.02 ? 0.03 : 0.1;
  synth.tilt_rad = one_of(kTilts, random) * kDegree;
  synth.noise = one_of(kNoises, random);
  synth.side = random.uniform() < 0.3 ? Handedness::left : Handedness::right;
  synth.hand_scale = one_of(kScales, random);
  synth.seed = 1 + random.next() % 1000;
  return drawn;
}

std::vector<SuiteCase> quick_cases(const SuiteOptions& options) {
  std::vector<SuiteCase> cases;
  for (const StrokePlace& where : stroke_places(options)) {
    if (where.object == "sphere:0.1" || where.place == "flank") continue;
    cases.push_back(base_case(where, options.size));
  }
  SuiteCase changed = base_case({"plane", ""}, options.size);
  changed.synth.stroke = Stroke::curl;
  changed.synth.side = Handedness::left;
  changed.synth.noise = NoiseModel::quest;
  cases.push_back(changed);
  return cases;
}

std::vector<SuiteCase> synthetic_cases(const SuiteOptions& options) {
  const std::vector<StrokePlace> places = stroke_places(options);
  std::vector<SuiteCase> cases;
  std::set<std::string> names;
  const auto add = [&](SuiteCase more) {
    if (names.insert(more.name()).second) cases.push_back(std::move(more));
  };
  const auto append = [&](std::vector<SuiteCase> more) {
    for (SuiteCase& one : more) add(std::move(one));
  };
  for (const StrokePlace& where : places) add(base_case(where, options.size));
  for (const StrokePlace& where : places) {
    const bool common = where.object == "plane" || where.object == "sphere:0.15" ||
                        (where.object == "dog" && where.place == "back");
    if (common || options.size == SuiteSize::full) append(variations(where, options.size));
  }
  append(hard_strokes(places, options.size));
  // Not over mesh files, so that the same strokes are drawn with and without them.
  const std::vector<StrokePlace> own = stroke_places({});
  Random random(kSeed);
  const int count = options.size == SuiteSize::full ? kRandomFull : kRandomNormal;
  for (int i = 0; i < count; ++i) add(random_case(own, options.size, random));
  return cases;
}

/// What of a stroke is unlike the base, for its name.
std::string peculiarities(const SynthOptions& synth) {
  std::string text;
  if (synth.tilt_rad != 0.0) text += fmt::format(" tilt {:+.0f}", synth.tilt_rad / kDegree);
  if (synth.noise != NoiseModel::none) text += fmt::format(" {}", name_of(synth.noise));
  if (synth.hand_scale != 1.0) text += fmt::format(" size {:g}", synth.hand_scale);
  if (synth.side == Handedness::left) text += " left";
  const bool seeded = synth.noise != NoiseModel::none && synth.seed != SynthOptions{}.seed;
  if (seeded) text += fmt::format(" #{}", synth.seed);
  return text;
}

Result<CaseRecording> read_clip(const SuiteCase& suite_case, const LoadedObject& object) {
  Result<RecordingReader> reader = RecordingReader::open(*suite_case.clip);
  if (!reader) return reader.error();
  CaseRecording recording;
  recording.header = reader->header();
  PalmTrack track;
  while (true) {
    Result<std::optional<RecordedFrame>> frame = reader->next();
    if (!frame) return frame.error();
    if (!frame->has_value()) break;
    track.add(**frame);
    recording.frames.push_back(std::move(**frame));
  }
  const Result<Placement> pressed = press(object, {}, track, suite_case.press_m);
  if (!pressed) {
    return Error{pressed.error().code,
                 fmt::format("{}: {}", *suite_case.clip, pressed.error().message)};
  }
  recording.placement = *pressed;
  return recording;
}

Result<CaseRecording> make_stroke(const SuiteCase& suite_case, const SuiteObject& object) {
  const Result<HandPose> relaxed = load_relaxed_hand(suite_case.synth.side);
  if (!relaxed) return relaxed.error();
  SynthOptions options = suite_case.synth;
  Placement guide;
  std::optional<LoadedObject> plane;
  if (object.guide == StrokeGuide::plane) {
    const Result<MeshPlace> place = object.loaded.place(options.place);
    if (!place) return place.error();
    Result<LoadedObject> loaded = load_object("plane");
    if (!loaded) return loaded.error();
    plane = std::move(loaded).value();
    guide.pose = place->pose;
    options.place.clear();
  }
  Result<StrokeSynth> synth =
      StrokeSynth::create(plane ? *plane : object.loaded, guide, *relaxed, options);
  if (!synth) return synth.error();
  CaseRecording recording;
  recording.header = synth->header();
  while (auto frame = synth->next()) recording.frames.push_back(std::move(*frame));
  return recording;
}

}  // namespace

bool SuiteCase::is_flat() const {
  constexpr double kFlatBall_m = 0.15;
  constexpr double kPressed_m = 0.01;
  if (scene || (clip ? press_m : synth.depth_m) < kPressed_m) return false;
  if (object == "plane" || object == "sphere") return true;
  constexpr std::string_view kBall = "sphere:";
  if (!object.starts_with(kBall)) return false;
  double radius_m = 0.0;
  std::from_chars(object.data() + kBall.size(), object.data() + object.size(), radius_m);
  return radius_m >= kFlatBall_m;
}

std::string SuiteCase::name() const {
  if (scene) return "scene/" + scene->name;
  const std::string file = std::filesystem::path(object).filename().string();
  const std::string thing =
      synth.place.empty() || clip ? file : fmt::format("{}/{}", file, synth.place);
  if (clip) {
    return fmt::format("{} {} pressed {:g} mm", thing, std::filesystem::path(*clip).stem().string(),
                       1e3 * press_m);
  }
  return fmt::format("{} {} {:g} m/s {:g} mm{}", thing, name_of(synth.stroke), synth.speed_m_per_s,
                     1e3 * synth.depth_m, peculiarities(synth));
}

std::vector<SuiteCase> suite_cases(const SuiteOptions& options) {
  std::vector<SuiteCase> cases =
      options.size == SuiteSize::quick ? quick_cases(options) : synthetic_cases(options);
  for (const std::string& clip : options.clips) {
    for (const char* const object : {"plane", "sphere:0.15", "dog"}) {
      SuiteCase pressed;
      pressed.object = object;
      pressed.clip = clip;
      cases.push_back(std::move(pressed));
    }
  }
  if (options.size == SuiteSize::quick) return cases;
  for (const std::shared_ptr<const BenchScene>& scene : options.scenes) {
    SuiteCase played;
    played.scene = scene;
    played.object = scene->object.empty() ? played.name() : scene->object;
    cases.push_back(std::move(played));
  }
  return cases;
}

Result<SuiteObject> load_case_object(const SuiteCase& suite_case) {
  return suite_case.scene ? load_scene_object(*suite_case.scene)
                          : load_suite_object(suite_case.object);
}

Result<SuiteObject> load_suite_object(const std::string& name) {
  const auto shaped = [&](MeshFile shape, StrokeGuide guide) -> Result<SuiteObject> {
    Result<LoadedObject> loaded = shape_object(name, std::move(shape));
    if (!loaded) return loaded.error();
    return SuiteObject{std::move(loaded).value(), guide};
  };
  if (name == "bowl") return shaped(bowl_shape(), StrokeGuide::surface);
  if (name == "board") return shaped(board_shape(), StrokeGuide::plane);
  if (name == "box") return shaped(box_shape(), StrokeGuide::plane);
  Result<LoadedObject> loaded = load_object(name);
  if (!loaded) return loaded.error();
  return SuiteObject{std::move(loaded).value(), StrokeGuide::surface};
}

Result<CaseRecording> make_recording(const SuiteCase& suite_case, const SuiteObject& object) {
  Result<CaseRecording> recording = suite_case.scene
                                        ? make_scene_recording(*suite_case.scene, object)
                                    : suite_case.clip ? read_clip(suite_case, object.loaded)
                                                      : make_stroke(suite_case, object);
  if (!recording) return recording;
  std::string& header = recording->header.unknown_json;
  header = with_placing(header, {object.loaded.spec, recording->placement});
  return recording;
}

TriangleSoup stretched(TriangleSoup soup, const Vec3& stretch) {
  for (Eigen::Vector3f& vertex : soup.vertices) {
    vertex = vertex.cwiseProduct(stretch.cast<float>());
  }
  return soup;
}

ObjectPlayer::ObjectPlayer(const CaseRecording& recording, const SuiteObject& object)
    : recording_(&recording), object_(&object), now_(object.loaded.placed(recording.placement)) {
  const bool stretches = std::ranges::any_of(
      recording.states, [](const ObjectState& state) { return state.stretch != Vec3::Ones(); });
  if (!stretches || !object.loaded.soup) return;
  auto mesh = MeshSurface::build(*object.loaded.soup, object.loaded.spec);
  if (mesh) stretching_ = std::move(mesh).value();
}

const Object& ObjectPlayer::at(std::size_t frame) {
  if (frame >= recording_->states.size()) return now_;
  const ObjectState& state = recording_->states[frame];
  if (!stretching_) {
    now_ = object_->loaded.placed(state.placement);
    return now_;
  }
  const std::vector<Eigen::Vector3f>& rest = object_->loaded.soup->vertices;
  vertices_.resize(rest.size());
  std::ranges::transform(rest, vertices_.begin(), [&](const Eigen::Vector3f& vertex) {
    return Eigen::Vector3f(vertex.cwiseProduct(state.stretch.cast<float>()));
  });
  stretching_->refit(vertices_);
  now_ = Object(*stretching_, composed(state.placement, object_->loaded.base));
  return now_;
}

}  // namespace nade
