#include "figure_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "console.h"
#include "nade/draw/camera.h"
#include "nade/eval/noise.h"
#include "nade/eval/shapes.h"
#include "nade/io/csv.h"
#include "nade/io/output_file.h"
#include "sheet_canvas.h"

namespace nade::cli {
namespace {

constexpr int kPanelWidth = 640;
constexpr int kPanelHeight = 480;
constexpr int kInsetWidth = 256;
constexpr int kInsetHeight = 192;
constexpr int kGap = 16;
constexpr int kHeader = kInsetHeight + 2 * kGap;
constexpr std::size_t kProbeEvery = 3;  // frames between those that are looked at for pressing
constexpr double kView = 26.0 * kDegree;
constexpr double kAspect = static_cast<double>(kPanelWidth) / kPanelHeight;

using Hands = std::array<std::optional<draw::StagedHand>, 2>;

/// One question.
struct Pair {
  const SuiteCase* suite_case = nullptr;
  double time_s = 0.0;
  std::array<std::size_t, 2> shown{0, 1};  ///< methods: left and right
};

/// A case, played by both methods.
struct PlayedCase {
  SuiteObject object;
  CaseRecording tracked;
  std::array<CorrectedRecording, 2> corrected;
  std::array<Method, 2> drawn{};  ///< which skin it has
};

Result<PlayedCase> play(const PairsPlan& plan, const SuiteCase& suite_case,
                        const DrawnHands& hands) {
  Result<SuiteObject> object = load_case_object(suite_case);
  if (!object) return object.error();
  Result<CaseRecording> tracked = make_recording(suite_case, *object);
  if (!tracked) return tracked.error();
  PlayedCase played{std::move(object).value(), std::move(tracked).value(), {}, {}};
  for (std::size_t m = 0; m < plan.methods.size(); ++m) {
    played.corrected[m] = correct(played.tracked, played.object, hands, plan.methods[m]);
    played.drawn[m] = method_from_name(plan.methods[m].name).value_or(Method::none);
  }
  return played;
}

/// Frames in which tracked skin is pressed in, a thinned list.
std::vector<std::size_t> pressing_frames(const PlayedCase& played, const DrawnHands& hands) {
  std::vector<std::size_t> pressing;
  ObjectPlayer player(played.tracked, played.object);
  for (std::size_t i = 0; i < played.tracked.frames.size(); i += kProbeEvery) {
    const RecordedFrame& frame = played.tracked.frames[i];
    for (std::size_t side = 0; side < 2; ++side) {
      const auto& hand = frame.hands[side];
      if (!hand || !played.corrected[0].frames[i].hands[side]) continue;
      MetricsMeter meter(hands.meshes[side], {hand_scale(hands.meshes[side], hand->pose)});
      if (meter.add(frame.time_ns, hand->pose, hand->pose, player.at(i)).penetration_mm) {
        pressing.push_back(i);
        break;
      }
    }
  }
  return pressing;
}

Hands hands_of(const PlayedCase& played, std::size_t frame, std::size_t method,
               const DrawnHands& drawn) {
  Hands hands;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto& tracked = played.tracked.frames[frame].hands[side];
    const auto& corrected = played.corrected[method].frames[frame].hands[side];
    if (!tracked || !corrected) continue;
    hands[side] = draw::StagedHand{tracked->pose,
                                   corrected->pose,
                                   {},
                                   hand_scale(drawn.meshes[side], tracked->pose),
                                   played.drawn[method]};
  }
  return hands;
}

/// The object as it is in a frame; of one that stretches another mesh.
Result<std::optional<LoadedObject>> stretched_object(const PlayedCase& played, std::size_t frame) {
  const bool rests =
      frame >= played.tracked.states.size() || played.tracked.states[frame].stretch == Vec3::Ones();
  if (rests || !played.object.loaded.soup) return std::optional<LoadedObject>{};
  MeshFile shape{stretched(*played.object.loaded.soup, played.tracked.states[frame].stretch), {}};
  Result<LoadedObject> loaded = shape_object(played.object.loaded.spec, std::move(shape));
  if (!loaded) return loaded.error();
  return std::optional<LoadedObject>(std::move(loaded).value());
}

/// How many joints, tracked and drawn, an eye sees past the object.
std::size_t joints_seen(const Vec3& eye, const std::array<Hands, 2>& by_method,
                        const Object& object) {
  std::size_t seen = 0;
  const auto look = [&](const HandPose& hand) {
    for (const Pose& joint : hand.joints) {
      const Vec3 way = joint.position - eye;
      if (!object.first_hit({eye, way.normalized(), way.norm()})) ++seen;
    }
  };
  for (const Hands& hands : by_method) {
    for (const auto& staged : hands) {
      if (!staged) continue;
      look(staged->tracked);
      look(staged->corrected);
    }
  }
  return seen;
}

/// Three-quarter and side from about the thumb's side, and from behind the wrist as its owner sees
/// it, each from where the object hides least of the hand. The same for both methods.
std::array<draw::Camera, 3> cameras_of(const std::array<Hands, 2>& by_method,
                                       const Object& object) {
  Eigen::AlignedBox3d box;
  const HandPose* hand = nullptr;
  for (const Hands& hands : by_method) {
    for (const auto& staged : hands) {
      if (!staged) continue;
      hand = &staged->tracked;
      for (const Pose& joint : staged->tracked.joints) box.extend(joint.position);
      for (const Pose& joint : staged->corrected.joints) box.extend(joint.position);
    }
  }
  const Quat palm = (*hand)[Joint::palm].rotation;
  const Vec3 thumb = palm * Vec3(hand->side == Handedness::right ? -1.0 : 1.0, 0.0, 0.0);
  const Vec3 ahead = palm * -Vec3::UnitZ();
  const double distance_m = 0.6 * box.diagonal().norm() / std::sin(0.5 * kView);
  const auto best = [&](const std::array<Vec3, 4>& outs) {
    Vec3 eye = Vec3::Zero();
    std::optional<std::size_t> most;
    for (const Vec3& out : outs) {
      const Vec3 from = box.center() + distance_m * out.normalized();
      const std::size_t seen = joints_seen(from, by_method, object);
      if (most && seen <= *most) continue;
      most = seen;
      eye = from;
    }
    return draw::looking_at(eye, box.center(), kView, kAspect);
  };
  const Vec3 back = hand->back();
  const Vec3 aside = 0.75 * thumb + 0.5 * ahead;
  const Vec3 behind = -0.8 * ahead;
  return {
      best({aside + 0.6 * back, aside - 0.6 * back, -aside + 0.6 * back, -aside - 0.6 * back}),
      best({thumb + 0.12 * back, thumb - 0.12 * back, -thumb + 0.12 * back, -thumb - 0.12 * back}),
      best({behind + 0.7 * back, behind + 0.2 * back, behind - 0.7 * back, behind + thumb})};
}

/// A pair's sheet: two columns, a row a view; above them, small, the tracked hand.
draw::Image draw_sheet(const Pair& pair, const std::string& name,
                       const std::array<Hands, 2>& by_method, const Object& object,
                       Studio& studio) {
  const draw::Color ink(0.015F, 0.02F, 0.03F);
  const std::array<draw::Camera, 3> cameras = cameras_of(by_method, object);
  SheetCanvas canvas(2 * kPanelWidth + 3 * kGap,
                     kHeader + static_cast<int>(cameras.size()) * (kPanelHeight + kGap));
  draw::StageFrame frame;
  frame.hands = by_method.front();
  frame.shown = draw::Shown::tracked;
  const auto take = [&](const draw::Camera& camera, int width, int height) {
    return studio.renderer->picture(studio.stage.arrange(frame), camera, width, height);
  };
  canvas.paste(take(cameras.front(), kInsetWidth, kInsetHeight), kGap, kGap);
  const float beside = kInsetWidth + 3.0F * kGap;
  canvas.text({beside, 24.0F}, name, 34.0F, ink);
  canvas.text({beside, 76.0F}, "Left here: where the person's hand really is.", 26.0F, ink);
  canvas.text({beside, 112.0F}, "Which of the two below looks more like a hand", 26.0F, ink);
  canvas.text({beside, 148.0F}, "that rests on this, or strokes it?", 26.0F, ink);
  frame.shown = draw::Shown::corrected;
  for (std::size_t column = 0; column < 2; ++column) {
    frame.hands = by_method[pair.shown[column]];
    const int left = kGap + static_cast<int>(column) * (kPanelWidth + kGap);
    for (std::size_t row = 0; row < cameras.size(); ++row) {
      canvas.paste(take(cameras[row], kPanelWidth, kPanelHeight), left,
                   kHeader + static_cast<int>(row) * (kPanelHeight + kGap));
    }
  }
  return canvas.image();
}

std::string name_of_pair(std::size_t index) { return fmt::format("pair_{:03}", index + 1); }

std::string page_of(std::size_t pairs) {
  std::string html =
      "<!doctype html>\n<meta charset=\"utf-8\">\n<title>Which hand rests?</title>\n"
      "<style>body{font:18px sans-serif;max-width:1330px;margin:auto}img{width:100%}"
      "label{margin-right:3em}</style>\n"
      "<p>Two pictures of one moment. Which looks more like a hand that rests on the object, or "
      "strokes it? The small picture shows where the person's hand really is.</p>\n";
  auto out = std::back_inserter(html);
  for (std::size_t i = 0; i < pairs; ++i) {
    const std::string name = name_of_pair(i);
    fmt::format_to(out, "<h2>{0}</h2>\n<img src=\"{0}.png\" alt=\"{0}\">\n<p>", name);
    for (const char* const answer : {"left", "right", "tie"}) {
      fmt::format_to(out, "<label><input type=\"radio\" name=\"{0}\" value=\"{1}\">{1}</label>",
                     name, answer);
    }
    html += "</p>\n";
  }
  html +=
      "<button onclick=\"save()\">Save answers.csv</button>\n<script>\nfunction save() {\n"
      "  const lines = [...document.querySelectorAll('input:checked')].map("
      "i => i.name + ',' + i.value);\n"
      "  const link = document.createElement('a');\n  link.download = 'answers.csv';\n"
      "  link.href = 'data:text/csv,' + encodeURIComponent("
      "['pair,answer', ...lines].join('\\n') + '\\n');\n  link.click();\n}\n</script>\n";
  return html;
}

/// What the pictures are asked with, and what they show.
Status write_texts(const PairsPlan& plan, const std::vector<Pair>& pairs) {
  std::string answers = "pair,answer\n";
  std::string key = "pair,case,time_s,left,right\n";
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Pair& pair = pairs[i];
    answers += name_of_pair(i) + ",\n";
    key += fmt::format("{},{},{:.3f},{},{}\n", name_of_pair(i), csv_field(pair.suite_case->name()),
                       pair.time_s, plan.methods[pair.shown[0]].name,
                       plan.methods[pair.shown[1]].name);
  }
  const std::filesystem::path folder(plan.folder);
  for (const auto& [name, text] : {std::pair("answers.csv", answers), std::pair("key.csv", key),
                                   std::pair("index.html", page_of(pairs.size()))}) {
    const Status written = write_whole((folder / name).string(), text);
    if (!written.ok()) return written;
  }
  return ok_status();
}

/// The cases in an order by chance.
std::vector<std::size_t> shuffled(std::size_t count, Random& random) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) {
    std::swap(order[i - 1],
              order[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
  }
  return order;
}

/// Draws one case's pair; none where its hand never presses.
Result<std::optional<Pair>> draw_case(const PairsPlan& plan, const SuiteCase& suite_case,
                                      const std::string& name, const DrawnHands& hands,
                                      Studio& studio, Random& random) {
  const Result<PlayedCase> played = play(plan, suite_case, hands);
  if (!played) return played.error();
  const std::vector<std::size_t> pressing = pressing_frames(*played, hands);
  if (pressing.empty()) return std::optional<Pair>{};
  const std::size_t frame =
      pressing[static_cast<std::size_t>(random.uniform() * static_cast<double>(pressing.size()))];
  Pair pair{&suite_case, 1e-9 * static_cast<double>(played->tracked.frames[frame].time_ns -
                                                    played->tracked.frames.front().time_ns)};
  if (random.uniform() < 0.5) std::swap(pair.shown[0], pair.shown[1]);
  const Result<std::optional<LoadedObject>> other = stretched_object(*played, frame);
  if (!other) return other.error();
  const Placement placement = played->tracked.states.empty()
                                  ? played->tracked.placement
                                  : played->tracked.states[frame].placement;
  const Status set = studio.stage.set_object(*other ? **other : played->object.loaded, placement);
  if (!set.ok()) return set.error();
  ObjectPlayer player(played->tracked, played->object);
  const draw::Image sheet = draw_sheet(
      pair, name, {hands_of(*played, frame, 0, hands), hands_of(*played, frame, 1, hands)},
      player.at(frame), studio);
  const Status saved =
      draw::save_png((std::filesystem::path(plan.folder) / (name + ".png")).string(), sheet);
  if (!saved.ok()) return saved.error();
  return std::optional<Pair>(pair);
}

}  // namespace

Status draw_pairs(const PairsPlan& plan, const DrawnHands& hands, Studio& studio) {
  std::error_code failed;
  std::filesystem::create_directories(plan.folder, failed);
  if (failed) {
    return Error{ErrorCode::unwritable, fmt::format("{}: {}", plan.folder, failed.message())};
  }
  Random random(plan.seed);
  std::vector<Pair> pairs;
  Progress progress("drew pairs:", plan.count);
  for (const std::size_t i : shuffled(plan.cases.size(), random)) {
    if (pairs.size() == plan.count) break;
    const Result<std::optional<Pair>> pair =
        draw_case(plan, plan.cases[i], name_of_pair(pairs.size()), hands, studio, random);
    if (!pair) {
      return Error{pair.error().code,
                   fmt::format("{}: {}", plan.cases[i].name(), pair.error().message)};
    }
    if (!*pair) continue;
    pairs.push_back(**pair);
    progress.step();
  }
  if (pairs.empty()) {
    return Error{ErrorCode::bad_value, "--pairs: in none of the cases does a hand press"};
  }
  return write_texts(plan, pairs);
}

}  // namespace nade::cli
