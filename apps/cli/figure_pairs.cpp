#include "figure_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "console.h"
#include "nade/draw/camera.h"
#include "nade/draw/film.h"
#include "nade/eval/noise.h"
#include "nade/io/csv.h"
#include "nade/io/output_file.h"
#include "played_case.h"
#include "sheet_canvas.h"

namespace nade::cli {
namespace {

constexpr int kPanelWidth = 640;
constexpr int kPanelHeight = 480;
constexpr int kInsetWidth = 256;
constexpr int kInsetHeight = 192;
constexpr int kPairGap = 16;
constexpr int kPairHeader = kInsetHeight + 2 * kPairGap;
constexpr int kSheetWidth = 2 * kPanelWidth + 3 * kPairGap;
constexpr int kViews = 3;
constexpr double kFilmRate = 30.0;
constexpr std::size_t kMomentsOfView = 8;         ///< of a film, that its view is chosen by
constexpr std::int64_t kFollow_ns = 250'000'000;  ///< before and after, that it is steadied over
constexpr double kPairView = 26.0 * kDegree;
constexpr double kAspect = static_cast<double>(kPanelWidth) / kPanelHeight;

/// One question.
struct Pair {
  const SuiteCase* suite_case = nullptr;
  double time_s = 0.0;
  std::array<std::size_t, 2> shown{0, 1};  ///< methods: left and right
};

/// How many joints, tracked and drawn, an eye sees past the object.
std::size_t joints_seen(const Vec3& eye, const HandsByMethod& by_method, const Object& object) {
  std::size_t seen = 0;
  const auto look = [&](const HandPose& hand) {
    for (const Pose& joint : hand.joints) {
      const Vec3 way = joint.position - eye;
      if (!object.first_hit({eye, way.normalized(), way.norm()})) ++seen;
    }
  };
  for (const draw::StagedHands& hands : by_method) {
    for (const auto& staged : hands) {
      if (!staged) continue;
      look(staged->tracked);
      look(staged->corrected);
    }
  }
  return seen;
}

/// Three-quarter and side from about the thumb's side, and from behind the wrist as its owner sees
/// it, each from where the object, as it is in the first of the moments, and the floor hide least
/// of the hand. They look at it where it is in that moment. The same for both methods.
std::array<draw::Camera, kViews> cameras_of(std::span<const HandsByMethod> moments,
                                            const Object& object, draw::Stage& stage) {
  const double floor_y = stage.arrange_object().floor_y;
  std::vector<Eigen::AlignedBox3d> boxes;
  double largest_m = 0.0;
  const HandPose* hand = nullptr;
  for (const HandsByMethod& by_method : moments) {
    Eigen::AlignedBox3d& box = boxes.emplace_back();
    for (const draw::StagedHands& hands : by_method) {
      for (const auto& staged : hands) {
        if (!staged) continue;
        if (!hand || &by_method == moments.data()) hand = &staged->tracked;
        for (const Pose& joint : staged->tracked.joints) box.extend(joint.position);
        for (const Pose& joint : staged->corrected.joints) box.extend(joint.position);
      }
    }
    if (!box.isEmpty()) largest_m = std::max(largest_m, box.diagonal().norm());
  }
  const Vec3 middle = boxes.front().center();
  const Quat palm = (*hand)[Joint::palm].rotation;
  const Vec3 thumb = palm * Vec3(hand->side == Handedness::right ? -1.0 : 1.0, 0.0, 0.0);
  const Vec3 ahead = palm * -Vec3::UnitZ();
  const double distance_m = 0.6 * largest_m / std::sin(0.5 * kPairView);
  const auto best = [&](const std::array<Vec3, 4>& outs) {
    Vec3 away = Vec3::Zero();
    std::optional<std::size_t> most;
    for (const Vec3& out : outs) {
      const Vec3 there = distance_m * out.normalized();
      std::size_t seen = 0;
      for (std::size_t i = 0; i < moments.size(); ++i) {
        if (boxes[i].isEmpty()) continue;
        const Vec3 from = boxes[i].center() + there;
        if (from.y() > floor_y) seen += joints_seen(from, moments[i], object);
      }
      if (most && seen <= *most) continue;
      most = seen;
      away = there;
    }
    return draw::looking_at(middle + away, middle, kPairView, kAspect);
  };
  const Vec3 back = hand->back();
  const Vec3 aside = 0.75 * thumb + 0.5 * ahead;
  const Vec3 behind = -0.8 * ahead;
  return {
      best({aside + 0.6 * back, aside - 0.6 * back, -aside + 0.6 * back, -aside - 0.6 * back}),
      best({thumb + 0.12 * back, thumb - 0.12 * back, -thumb + 0.12 * back, -thumb - 0.12 * back}),
      best({behind + 0.7 * back, behind + 0.2 * back, behind - 0.7 * back, behind + thumb})};
}

int sheet_height(std::size_t views) {
  return kPairHeader + static_cast<int>(views) * (kPanelHeight + kPairGap);
}

/// A pair's sheet: two columns, a row a view; above them, small, the tracked hand.
draw::Image draw_sheet(const Pair& pair, const std::string& name, const HandsByMethod& by_method,
                       std::span<const draw::Camera> views, Studio& studio) {
  const draw::Color ink(0.015F, 0.02F, 0.03F);
  SheetCanvas canvas(kSheetWidth, sheet_height(views.size()));
  draw::StageFrame frame;
  frame.hands = by_method.front();
  frame.shown = draw::Shown::tracked;
  const auto take = [&](const draw::Camera& camera, int width, int height) {
    return studio.renderer->picture(studio.stage.arrange(frame), camera, width, height);
  };
  canvas.paste(take(views.front(), kInsetWidth, kInsetHeight), kPairGap, kPairGap);
  const float beside = kInsetWidth + 3.0F * kPairGap;
  canvas.text({beside, 24.0F}, name, 34.0F, ink);
  canvas.text({beside, 76.0F}, "Left here: where the person's hand really is.", 26.0F, ink);
  canvas.text({beside, 112.0F}, "Which of the two below looks more like a hand", 26.0F, ink);
  canvas.text({beside, 148.0F}, "that rests on this, or strokes it?", 26.0F, ink);
  frame.shown = draw::Shown::corrected;
  for (std::size_t column = 0; column < 2; ++column) {
    frame.hands = by_method[pair.shown[column]];
    const int left = kPairGap + static_cast<int>(column) * (kPanelWidth + kPairGap);
    for (std::size_t row = 0; row < views.size(); ++row) {
      canvas.paste(take(views[row], kPanelWidth, kPanelHeight), left, sheet_height(row));
    }
  }
  return canvas.image();
}

/// The frames that a film of so long a time around one shows.
std::vector<std::size_t> film_frames(const std::vector<RecordedFrame>& frames, std::size_t middle,
                                     double film_s) {
  const std::int64_t from_ns = std::max(
      frames.front().time_ns, frames[middle].time_ns - static_cast<std::int64_t>(0.5e9 * film_s));
  std::vector<std::size_t> shown;
  std::size_t next = 0;
  for (int i = 0; i < static_cast<int>(film_s * kFilmRate); ++i) {
    const std::int64_t time_ns = from_ns + static_cast<std::int64_t>(1e9 / kFilmRate * i);
    while (next < frames.size() && frames[next].time_ns < time_ns) ++next;
    if (next == frames.size()) break;
    shown.push_back(next);
  }
  return shown;
}

/// Where the tracked palms are around a frame's time, in the mean; none where there is no hand.
std::optional<Vec3> palms_around(const std::vector<RecordedFrame>& frames, std::size_t at) {
  Vec3 sum = Vec3::Zero();
  int count = 0;
  const auto take = [&](const RecordedFrame& frame) {
    if (std::abs(frame.time_ns - frames[at].time_ns) > kFollow_ns) return false;
    for (const auto& hand : frame.hands) {
      if (!hand) continue;
      sum += hand->pose[Joint::palm].position;
      ++count;
    }
    return true;
  };
  std::size_t after = at;
  while (after < frames.size() && take(frames[after])) ++after;
  std::size_t before = at;
  while (before > 0 && take(frames[before - 1])) --before;
  if (count == 0) return std::nullopt;
  return sum / count;
}

/// Films the time around a pair's moment, from its first view, which follows the hand.
Status draw_film(const std::string& path, double film_s, const Pair& pair, const std::string& name,
                 const PlayedCase& played, std::size_t middle, const DrawnHands& hands,
                 Studio& studio) {
  const std::vector<std::size_t> frames = film_frames(played.tracked.frames, middle, film_s);
  std::vector<HandsByMethod> moments{hands_in(played, middle, hands)};
  for (std::size_t i = 0; i < frames.size(); i += 1 + frames.size() / kMomentsOfView) {
    moments.push_back(hands_in(played, frames[i], hands));
  }
  ObjectPlayer player(played.tracked, played.object);
  const draw::Camera view = cameras_of(moments, player.at(middle), studio.stage).front();
  Result<draw::FilmWriter> film =
      draw::FilmWriter::create(path, {kSheetWidth, sheet_height(1), kFilmRate});
  if (!film) return film.error();
  CaseStager stager(played, studio.stage);
  const std::optional<Vec3> start = palms_around(played.tracked.frames, middle);
  draw::Camera following = view;
  for (const std::size_t frame : frames) {
    const Status set = stager.set_frame(frame);
    if (!set) return set;
    const std::optional<Vec3> there = palms_around(played.tracked.frames, frame);
    if (start && there) following.pose.position = view.pose.position + *there - *start;
    const Status added =
        film->add(draw_sheet(pair, name, hands_in(played, frame, hands), {&following, 1}, studio));
    if (!added) return added;
  }
  return film->finish();
}

std::string name_of_pair(std::size_t index) { return fmt::format("pair_{:03}", index + 1); }

std::string page_of(const PairsPlan& plan, std::size_t pairs) {
  std::string html =
      "<!doctype html>\n<meta charset=\"utf-8\">\n<title>Which hand rests?</title>\n"
      "<style>body{font:18px sans-serif;max-width:1330px;margin:auto}img,video{width:100%}"
      "label{margin-right:3em}</style>\n"
      "<p>Two pictures of one moment. Which looks more like a hand that rests on the object, or "
      "strokes it? The small picture shows where the person's hand really is.</p>\n";
  auto out = std::back_inserter(html);
  for (std::size_t i = 0; i < pairs; ++i) {
    const std::string name = name_of_pair(i);
    fmt::format_to(out, "<h2>{0}</h2>\n<img src=\"{0}.png\" alt=\"{0}\">\n", name);
    if (plan.film_s > 0.0)
      fmt::format_to(out, "<video src=\"{0}.mp4\" controls loop></video>\n", name);
    html += "<p>";
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
                                   std::pair("index.html", page_of(plan, pairs.size()))}) {
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
  const Result<PlayedCase> played = play_case(plan.methods, suite_case, hands);
  if (!played) return played.error();
  const std::vector<std::size_t> pressing = pressing_frames(*played, hands);
  if (pressing.empty()) return std::optional<Pair>{};
  const std::size_t frame =
      pressing[static_cast<std::size_t>(random.uniform() * static_cast<double>(pressing.size()))];
  Pair pair{&suite_case, 1e-9 * static_cast<double>(played->tracked.frames[frame].time_ns -
                                                    played->tracked.frames.front().time_ns)};
  if (random.uniform() < 0.5) std::swap(pair.shown[0], pair.shown[1]);
  CaseStager stager(*played, studio.stage);
  const Status set = stager.set_frame(frame);
  if (!set.ok()) return set.error();
  ObjectPlayer player(played->tracked, played->object);
  const HandsByMethod shown = hands_in(*played, frame, hands);
  const std::array<draw::Camera, kViews> views =
      cameras_of({&shown, 1}, player.at(frame), studio.stage);
  const std::string path = (std::filesystem::path(plan.folder) / name).string();
  const Status saved = draw::save_png(path + ".png", draw_sheet(pair, name, shown, views, studio));
  if (!saved.ok()) return saved.error();
  if (plan.film_s > 0.0) {
    const Status filmed =
        draw_film(path + ".mp4", plan.film_s, pair, name, *played, frame, hands, studio);
    if (!filmed.ok()) return filmed.error();
  }
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
