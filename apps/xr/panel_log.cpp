#include "panel_log.h"

#include <nlohmann/json.hpp>

namespace nade::xr {

PanelLog::PanelLog(const std::string& path) : file_(std::fopen(path.c_str(), "w")) {}

void PanelLog::note(const Room& room) {
  const Pose pose = room.panel_pose();
  const bool moved = !place_ || (*place_ - pose.position).norm() > 1e-4;
  if (!file_ || (!moved && revision_ == room.panel_revision())) return;
  revision_ = room.panel_revision();
  place_ = pose.position;
  nlohmann::ordered_json line;
  const study::PanelView& view = room.show().panel;
  line["heading"] = view.heading;
  line["lines"] = view.lines;
  const Quat& q = pose.rotation;
  line["turn"] = {q.x(), q.y(), q.z(), q.w()};
  line["buttons"] = nlohmann::ordered_json::array();
  std::size_t next = 0;
  for (const auto& row : view.rows) {
    for (const study::PanelButton& button : row) {
      const Vec3 at = pose.apply(middle_of(room.panel().buttons[next++]));
      line["buttons"].push_back({{"id", button.id},
                                 {"label", button.label},
                                 {"chosen", button.chosen},
                                 {"enabled", button.enabled},
                                 {"at", {at.x(), at.y(), at.z()}}});
    }
  }
  std::fprintf(file_.get(), "%s\n", line.dump().c_str());
  static_cast<void>(std::fflush(file_.get()));
}

}  // namespace nade::xr
