#include "session.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "nade/eval/press.h"
#include "nade/eval/recording_pair.h"

namespace nade::viewer {
namespace {

constexpr std::array<MethodChoice, 3> kMethods{{
    {Method::nade, "nade", "Ours: the whole hand settles on the surface"},
    {Method::paper, "paper", "The method of 2023: palm and fingertips are put onto the surface"},
    {Method::none, "none", "The hand as it was tracked, sunk in where it pressed"},
}};

/// What a corrector has to have seen before a frame that is jumped to.
constexpr std::int64_t kLeadIn_ns = 1'500'000'000;
/// So many frames of a recording are caught up with in one frame of the window.
constexpr std::size_t kCatchUpMax = 240;
constexpr double kPressAtFirst_m = 0.02;

}  // namespace

std::span<const MethodChoice> method_choices() { return kMethods; }

Session::Session(Setup setup)
    : setup_(std::move(setup)),
      mouse_hand_(setup_.relaxed),
      correctors_{HandCorrector(setup_.corrector), HandCorrector(setup_.corrector)},
      figures_(setup_.meshes) {}

Status Session::show_object(const std::string& spec, const std::optional<Placement>& placement) {
  Result<LoadedObject> loaded = load_object(spec);
  if (!loaded) return loaded.error();
  const auto before =
      std::exchange(loaded_, std::make_shared<LoadedObject>(std::move(loaded).value()));
  const Placement stood = std::exchange(placement_, placement.value_or(Placement{}));
  placed_by_hand_ = placement.has_value();
  if (clip_begun_ && !placement) {
    const Status stands = stand_under_clip();
    if (!stands) {
      loaded_ = before;
      placement_ = stood;
      return stands;
    }
  }
  for (const std::string& warning : loaded_->warnings) notices_.push_back(warning);
  const std::string facing = facing_hint(*loaded_, placement_.pose.rotation);
  if (!facing.empty()) notices_.push_back(loaded_->spec + ": " + facing);
  put_mouse_hand();
  restart();
  return ok_status();
}

Status Session::open_clip(const std::string& path) {
  Result<Clip> opened = Clip::open(path);
  if (!opened) return opened.error();
  if (clip_begun_) clip_before_ = std::move(clip_);
  clip_.emplace(std::move(opened).value());
  clip_begun_ = false;
  return ok_status();
}

Status Session::open_any(const std::string& path) {
  const Status as_recording = open_clip(path);
  if (as_recording.ok()) return as_recording;
  const Status as_mesh = show_object(path);
  if (as_mesh.ok()) return as_mesh;
  // Of the two reasons why it is neither, the one that its owner looks for.
  return has_mesh_ending(path) ? as_mesh : as_recording;
}

void Session::close_clip() {
  clip_.reset();
  clip_before_.reset();
  clip_begun_ = false;
  press_m_.reset();
  hands_ = {};
  scales_ = {};
  return_to_method();
  put_mouse_hand();
  restart();
}

void Session::put_mouse_hand() {
  if (clip_ || !loaded_) return;
  const Result<MeshPlace> place = loaded_->place();
  if (!place) return;
  mouse_hand_.place(object(), {placement_.to_world(place->pose.position),
                               placement_.pose.rotation * place->pose.rotation});
}

void Session::return_to_method() {
  if (method_before_) setup_.corrector.method = *method_before_;
  method_before_.reset();
}

void Session::set_corrector(const CorrectorOptions& options) {
  if (options.method != setup_.corrector.method) method_before_.reset();
  setup_.corrector = options;
  restart();
}

void Session::set_settle(const SettleOptions& settle) {
  setup_.corrector.settle = settle;
  if (clip_begun_) {  // the picture shown is corrected anew
    restart();
    return;
  }
  for (HandCorrector& corrector : correctors_) corrector.set_settle(settle);
}

void Session::restart() {
  for (HandCorrector& corrector : correctors_) corrector = HandCorrector(setup_.corrector);
  figures_.restart();
  if (clip_begun_) seek(playback_.index);
}

Status Session::press(double depth_m) {
  if (!clip_begun_) return ok_status();
  const Result<Placement> pressed = nade::press(*loaded_, placement_, clip_->palms(), depth_m);
  if (!pressed) {
    return Error{pressed.error().code,
                 fmt::format("{}: {}", loaded_->spec, pressed.error().message)};
  }
  placement_ = *pressed;
  press_m_ = depth_m;
  placed_by_hand_ = false;
  restart();
  return ok_status();
}

Status Session::stand_under_clip() {
  const double depth_m = press_m_.value_or(kPressAtFirst_m);
  const Result<Placement> pressed = nade::press(*loaded_, placement_, clip_->palms(), depth_m);
  if (!pressed) {
    return Error{pressed.error().code,
                 fmt::format("{}: {}", loaded_->spec, pressed.error().message)};
  }
  placement_ = *pressed;
  press_m_ = depth_m;
  return ok_status();
}

void Session::begin_clip() {
  for (const std::string& warning : clip_->warnings()) notices_.push_back(warning);
  const auto failure = clip_->failure();
  if (failure || clip_->size() == 0) {
    notices_.push_back(
        failure ? failure->message
                : fmt::format("{}: expected frames with hands, found none", clip_->path()));
    clip_ = std::exchange(clip_before_, std::nullopt);
    clip_begun_ = clip_.has_value();
    return;
  }
  clip_before_.reset();
  clip_begun_ = true;
  ++clips_begun_;
  hands_ = {};
  scales_ = {};
  playback_.time_s = 0.0;
  playback_.index = 0;
  playback_.playing = true;
  return_to_method();
  const Status stands = stand_as_recorded();
  if (!stands) notices_.push_back(stands.error().message);
  keep_ = Keep::no;
  restart();
}

Status Session::stand_as_recorded() {
  recorded_.reset();
  recorded_softness_m_ = 0.0;
  recorded_method_ = Method::none;
  const RecordingHeader& header = clip_->header();
  if (!method_of(header).empty()) {
    method_before_ = std::exchange(setup_.corrector.method, Method::none);
    notices_.push_back(
        fmt::format("{} is corrected already: it is shown as it is, method none", clip_->path()));
    recorded_softness_m_ = softness_from(header.unknown_json);
    recorded_method_ = method_from_name(method_of(header)).value_or(Method::none);
  }
  const auto recorded = placing_from(header.unknown_json, clip_->path());
  if (!recorded) return recorded.error();
  recorded_ = *recorded;
  const bool fits = *recorded && (keep_ == Keep::no ||
                                  object_name((*recorded)->object) == object_name(loaded_->spec));
  if (fits && !placed_by_hand_) {
    press_m_.reset();
    const Status shown = show_object((*recorded)->object, (*recorded)->placement);
    placed_by_hand_ = false;  // by the recording: another object is pressed under it
    if (shown.ok()) return shown;
    notices_.push_back(shown.error().message);
  }
  return placed_by_hand_ ? ok_status() : stand_under_clip();
}

/// With the first frame on, where the header does not say otherwise of this object.
double Session::animation_time_s(std::int64_t clip_time_ns) const {
  const bool says =
      recorded_ && recorded_->object == loaded_->spec && recorded_->animation_start_ns;
  const std::int64_t start_ns = says ? *recorded_->animation_start_ns - clip_->start_ns() : 0;
  return 1e-9 * static_cast<double>(clip_time_ns - start_ns);
}

double Session::softness_m() const {
  switch (setup_.corrector.method) {
    case Method::nade:
      return setup_.corrector.settle.softness_m;
    case Method::none:
      return clip_begun_ ? recorded_softness_m_ : 0.0;
    case Method::paper:
      break;
  }
  return 0.0;
}

Method Session::drawn_method() const {
  const Method method = setup_.corrector.method;
  return method == Method::none && clip_begun_ ? recorded_method_ : method;
}

void Session::seek(std::size_t index) {
  if (!clip_begun_) return;
  const std::size_t wanted = std::min(index, clip_->size() - 1);
  const std::int64_t time_ns = clip_->time_ns(wanted);
  for (HandCorrector& corrector : correctors_) corrector.reset();
  figures_.break_off();
  for (std::size_t i = clip_->index_at(std::max<std::int64_t>(0, time_ns - kLeadIn_ns)); i < wanted;
       ++i) {
    show_frame(i, Measured::no);
  }
  show_frame(wanted, Measured::yes);
  playback_.index = wanted;
  playback_.time_s = 1e-9 * static_cast<double>(time_ns);
}

void Session::play_or_pause() {
  if (!clip_begun_) return;
  if (!playback_.playing && playback_.index + 1 == clip_->size()) seek(0);
  playback_.playing = !playback_.playing;
}

void Session::step(int frames) {
  if (!clip_begun_) return;
  playback_.playing = false;
  const auto last = static_cast<std::int64_t>(clip_->size()) - 1;
  const std::int64_t wanted =
      std::clamp<std::int64_t>(static_cast<std::int64_t>(playback_.index) + frames, 0, last);
  if (frames == 1 && wanted > static_cast<std::int64_t>(playback_.index)) {
    playback_.index = static_cast<std::size_t>(wanted);
    playback_.time_s = 1e-9 * static_cast<double>(clip_->time_ns(playback_.index));
    show_frame(playback_.index, Measured::yes);
    return;
  }
  seek(static_cast<std::size_t>(wanted));
}

void Session::advance(double step_s, const Aim& aim) {
  if (clip_) {
    if (!clip_begun_ && clip_->complete()) begin_clip();
    if (clip_begun_) advance_clip(step_s);
    return;
  }
  if (!loaded_) return;
  mouse_time_ns_ += std::llround(1e9 * step_s);
  loaded_->move_to(1e-9 * static_cast<double>(mouse_time_ns_));
  const HandPose tracked = mouse_hand_.update(object(), aim, step_s);
  hands_[1 - index_of(tracked.side)].reset();
  correct(tracked, mouse_time_ns_, Measured::yes);
  figures_.end_frame();
}

void Session::advance_clip(double step_s) {
  if (!playback_.playing) return;
  playback_.time_s += playback_.speed * step_s;
  const double length_s = 1e-9 * static_cast<double>(clip_->time_ns(clip_->size() - 1));
  if (playback_.time_s > length_s) {
    if (playback_.loop) {
      seek(0);
    } else {
      seek(clip_->size() - 1);
      playback_.playing = false;
    }
    return;
  }
  const std::size_t wanted = clip_->index_at(std::llround(1e9 * playback_.time_s));
  if (wanted < playback_.index || wanted > playback_.index + kCatchUpMax) {
    const double time_s = playback_.time_s;
    seek(wanted);
    playback_.time_s = time_s;
    return;
  }
  while (playback_.index < wanted) show_frame(++playback_.index, Measured::yes);
}

void Session::show_frame(std::size_t index, Measured measured) {
  const ClipFrame frame = clip_->frame(index);
  loaded_->move_to(animation_time_s(clip_->time_ns(index)));
  for (std::size_t side = 0; side < 2; ++side) {
    if (!frame.hands[side]) {
      hands_[side].reset();
      continue;
    }
    correct(*frame.hands[side], frame.time_ns, measured);
  }
  if (measured == Measured::yes) figures_.end_frame();
}

void Session::correct(const HandPose& tracked, std::int64_t time_ns, Measured measured) {
  const std::size_t side = index_of(tracked.side);
  const Object where = object();
  const auto start = std::chrono::steady_clock::now();
  const CorrectedHand& corrected = correctors_[side].update(tracked, where, time_ns);
  const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
  corrected_[side] = &corrected;
  if (!scales_[side]) scales_[side] = hand_scale(setup_.meshes[side], tracked);
  hands_[side] =
      draw::StagedHand{tracked, corrected.pose, corrected.contacts, scales_[side], drawn_method()};
  if (measured == Measured::no) return;
  const bool timed = setup_.timing == Timing::real;
  figures_.add(time_ns, *hands_[side], where,
               timed ? std::optional<double>(took.count()) : std::nullopt);
}

std::vector<std::string> Session::take_notices() { return std::exchange(notices_, {}); }

}  // namespace nade::viewer
