#include "desk.h"

#include <algorithm>

namespace nade::viewer {
namespace {

constexpr double kNoticeSeconds = 12.0;
constexpr std::size_t kNoticesMax = 4;
/// What is framed of a large object, about the hand.
constexpr double kFramedMax_m = 0.2;

}  // namespace

void Desk::tell(const std::string& sentence) {
  std::erase_if(notices, [&](const Notice& notice) { return notice.text == sentence; });
  notices.push_back({sentence, kNoticeSeconds});
  if (notices.size() > kNoticesMax) notices.erase(notices.begin());
}

void Desk::tell(const Status& status) {
  if (!status.ok()) tell(status.error().message);
}

void Desk::show_object(const std::string& spec) {
  const Status shown_object = session.show_object(spec);
  tell(shown_object);
  if (shown_object.ok()) look(camera.view());
}

void Desk::choose_method(Method method) {
  CorrectorOptions options = session.corrector();
  options.method = method;
  session.set_corrector(options);
}

void Desk::look(draw::View view) {
  Vec3 center = session.mouse_hand().anchor();
  for (const auto& hand : session.hands()) {
    if (session.clip() != nullptr && hand) center = hand->tracked[Joint::palm].position;
  }
  camera.look(view, center, kFramedMax_m);
}

void Desk::open(const std::string& path) {
  const LoadedObject* const before = session.has_object() ? &session.loaded() : nullptr;
  tell(session.open_any(path));
  if (session.has_object() && &session.loaded() != before) look(camera.view());
}

void Desk::hold_as_at_first() {
  MouseHandSettings& hand = session.mouse_hand().settings();
  const Handedness side = hand.side;
  hand = {};
  hand.side = side;
}

}  // namespace nade::viewer
