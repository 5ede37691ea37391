#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "viewer.h"

namespace nade::viewer {
namespace {

constexpr double kTurnPerSecond_rad = 90.0 * kDegree;
constexpr double kTiltPerSecond_rad = 60.0 * kDegree;
constexpr double kTiltMost_rad = 60.0 * kDegree;
constexpr double kShapePerSecond = 1.5;
constexpr double kZoomPerSecond = 8.0;
constexpr std::array<double, 6> kSpeeds{0.1, 0.25, 0.5, 1.0, 2.0, 4.0};

/// How far two keys that work against each other move something in this frame.
double pull(const Input& input, Key up, Key down, double per_second) {
  double way = 0.0;
  if (input.is_held(up)) way += per_second * input.step_s;
  if (input.is_held(down)) way -= per_second * input.step_s;
  return way;
}

void hold_hand(Desk& desk, const Input& input) {
  MouseHandSettings& hand = desk.session.mouse_hand().settings();
  hand.turn_rad = std::remainder(hand.turn_rad + pull(input, Key::q, Key::e, kTurnPerSecond_rad),
                                 2.0 * std::numbers::pi);
  const auto tilt = [&](double& value, Key up, Key down) {
    value = std::clamp(value + pull(input, up, down, kTiltPerSecond_rad), -kTiltMost_rad,
                       kTiltMost_rad);
  };
  tilt(hand.tilt_rad, Key::w, Key::s);
  tilt(hand.roll_rad, Key::d, Key::a);
  hand.shape.curl =
      std::clamp(hand.shape.curl + pull(input, Key::f, Key::r, kShapePerSecond), -0.5, 1.5);
  hand.shape.spread =
      std::clamp(hand.shape.spread + pull(input, Key::g, Key::t, kShapePerSecond), -1.0, 1.5);
}

void next_object(Desk& desk) {
  static constexpr std::array<const char*, 3> kSpecs{"plane", "sphere", "dog"};
  const auto now = std::find(kSpecs.begin(), kSpecs.end(), desk.session.loaded().spec);
  desk.show_object(now == kSpecs.end() || now + 1 == kSpecs.end() ? kSpecs.front() : *(now + 1));
}

void next_method(Desk& desk) {
  const auto choices = method_choices();
  const auto now = std::find_if(choices.begin(), choices.end(), [&](const MethodChoice& choice) {
    return choice.method == desk.session.corrector().method;
  });
  desk.choose_method(now + 1 >= choices.end() ? choices.front().method : (now + 1)->method);
}

void change_speed(Playback& playback, int steps) {
  const auto now = std::lower_bound(kSpeeds.begin(), kSpeeds.end(), playback.speed);
  const auto at = std::clamp<std::ptrdiff_t>(now - kSpeeds.begin() + steps, 0,
                                             static_cast<std::ptrdiff_t>(kSpeeds.size()) - 1);
  playback.speed = kSpeeds[static_cast<std::size_t>(at)];
}

void take_clip_key(Session& session, Key key) {
  Playback& playback = session.playback();
  switch (key) {
    case Key::space:
      session.play_or_pause();
      break;
    case Key::left:
      session.step(-1);
      break;
    case Key::right:
      session.step(1);
      break;
    case Key::home:
      session.seek(0);
      break;
    case Key::end:
      session.seek(session.clip()->size());
      break;
    case Key::comma:
      change_speed(playback, -1);
      break;
    case Key::period:
      change_speed(playback, 1);
      break;
    case Key::l:
      playback.loop = !playback.loop;
      break;
    default:
      break;
  }
}

void take_key(Desk& desk, Key key) {
  MouseHandSettings& hand = desk.session.mouse_hand().settings();
  switch (key) {
    case Key::one:
      desk.look(draw::View::front);
      break;
    case Key::two:
      desk.look(draw::View::side);
      break;
    case Key::three:
      desk.look(draw::View::top);
      break;
    case Key::four:
      desk.look(draw::View::three_quarter);
      break;
    case Key::five:
      desk.look(draw::View::first_person);
      break;
    case Key::o:
      next_object(desk);
      break;
    case Key::m:
      next_method(desk);
      break;
    case Key::b:
      desk.shown = static_cast<draw::Shown>((static_cast<int>(desk.shown) + 1) % 3);
      break;
    case Key::x:
      hand.side = hand.side == Handedness::left ? Handedness::right : Handedness::left;
      break;
    case Key::c:
      desk.hold_as_at_first();
      break;
    case Key::z:
      desk.session.figures().restart();
      break;
    case Key::tab:
      desk.panels = !desk.panels;
      break;
    case Key::h:
    case Key::question:
      desk.help = !desk.help;
      break;
    case Key::escape:
      desk.help = false;
      break;
    default:
      break;
  }
}

}  // namespace

void take_keys(Desk& desk, const Input& input) {
  for (const Key key : input.pressed) {
    take_key(desk, key);
    if (desk.session.clip() != nullptr && !desk.session.loading()) {
      take_clip_key(desk.session, key);
    }
  }
  if (desk.session.clip() == nullptr) hold_hand(desk, input);
  desk.camera.zoom(pull(input, Key::plus, Key::minus, kZoomPerSecond));
}

}  // namespace nade::viewer
