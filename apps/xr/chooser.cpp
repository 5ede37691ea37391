#include "chooser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

namespace nade::xr {
namespace {

constexpr int kFirstObject = 100;
constexpr int kFirstMethod = 200;
constexpr int kCorrected = 300;
constexpr int kGhost = 301;
constexpr int kTracked = 302;
constexpr int kRecentre = 400;
constexpr int kLower = 401;
constexpr int kHigher = 402;
constexpr int kLeave = 403;

constexpr double kStep_m = 0.02;
constexpr std::int64_t kBetweenTimes_ns = 1'000'000'000;

constexpr std::array<Method, 3> kMethods{Method::none, Method::paper, Method::nade};

}  // namespace

std::string short_name(const std::string& object) {
  const std::string before = object.substr(0, object.find(':'));
  const std::string stem = std::filesystem::path(before).stem().string();
  return stem.empty() ? object : stem;
}

std::vector<std::string> button_names(const std::vector<std::string>& objects) {
  // After the ":" no folder begins.
  const auto without_folders = [](const std::string& object) {
    const std::size_t folders = object.substr(0, object.find(':')).find_last_of('/');
    return folders == std::string::npos ? object : object.substr(folders + 1);
  };
  const auto is_unlike_others = [&objects](const std::string& name, const auto& name_of) {
    return std::count_if(objects.begin(), objects.end(),
                         [&](const std::string& object) { return name_of(object) == name; }) == 1;
  };
  std::vector<std::string> names;
  for (const std::string& object : objects) {
    names.push_back(short_name(object));
    if (is_unlike_others(names.back(), short_name)) continue;
    names.back() = without_folders(object);
    if (!is_unlike_others(names.back(), without_folders)) names.back() = object;
  }
  return names;
}

Chooser::Chooser(Setup setup) : setup_(std::move(setup)) {
  show_.object = setup_.objects.front();
  show_.method = setup_.method;
  show_.shown = setup_.shown;
  rebuild();
}

void Chooser::rebuild() {
  study::PanelView panel;
  panel.heading = "nade";
  if (setup_.show_time) {
    panel.lines.push_back(fmt::format("correction {:.0f} µs a frame", time_us_));
  }
  const std::vector<std::string> names = button_names(setup_.objects);
  std::vector<study::PanelButton> row;
  for (std::size_t i = 0; i < setup_.objects.size(); ++i) {
    row.push_back(
        {kFirstObject + static_cast<int>(i), names[i], setup_.objects[i] == show_.object});
  }
  panel.rows.push_back(row);
  row.clear();
  for (std::size_t i = 0; i < kMethods.size(); ++i) {
    row.push_back({kFirstMethod + static_cast<int>(i), std::string(name_of(kMethods[i])),
                   kMethods[i] == show_.method});
  }
  panel.rows.push_back(row);
  panel.rows.push_back({{kCorrected, "corrected", show_.shown == draw::Shown::corrected},
                        {kGhost, "with ghost", show_.shown == draw::Shown::both},
                        {kTracked, "as tracked", show_.shown == draw::Shown::tracked}});
  panel.rows.push_back(
      {{kRecentre, "recentre"}, {kLower, "lower"}, {kHigher, "higher"}, {kLeave, "leave"}});
  show_.panel = std::move(panel);
  changed_ = true;
}

bool Chooser::changed() { return std::exchange(changed_, false); }

void Chooser::press(int button) {
  const auto at = [button](int first) { return static_cast<std::size_t>(button - first); };
  if (button >= kFirstObject && at(kFirstObject) < setup_.objects.size()) {
    show_.object = setup_.objects[at(kFirstObject)];
  } else if (button >= kFirstMethod && at(kFirstMethod) < kMethods.size()) {
    show_.method = kMethods[at(kFirstMethod)];
  }
  if (button == kCorrected) show_.shown = draw::Shown::corrected;
  if (button == kGhost) show_.shown = draw::Shown::both;
  if (button == kTracked) show_.shown = draw::Shown::tracked;
  if (button == kRecentre) wishes_.recentre = true;
  if (button == kLower) wishes_.raise_m -= kStep_m;
  if (button == kHigher) wishes_.raise_m += kStep_m;
  if (button == kLeave) wishes_.leave = true;
  rebuild();
}

void Chooser::seen(const Moment& moment) {
  if (!setup_.show_time || moment.motion.time_ns - time_told_ns_ < kBetweenTimes_ns) return;
  time_told_ns_ = moment.motion.time_ns;
  time_us_ = moment.correction_us;
  rebuild();
}

Guide::Wishes Chooser::take_wishes() { return std::exchange(wishes_, {}); }

}  // namespace nade::xr
