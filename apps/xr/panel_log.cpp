#include "panel_log.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

namespace nade::xr {

namespace {

Error unwritable(const std::string& path) {
  return {ErrorCode::unwritable,
          fmt::format("{}: expected to write the panel log, but: {}", path, std::strerror(errno))};
}

}  // namespace

Result<PanelLog> PanelLog::create(const std::string& path) {
  File file(std::fopen(path.c_str(), "w"));
  if (!file) return unwritable(path);
  return PanelLog(path, std::move(file));
}

Status PanelLog::note(const Room& room) {
  const Pose pose = room.panel_pose();
  const bool moved = !place_ || (*place_ - pose.position).norm() > 1e-4;
  if (!moved && revision_ == room.panel_revision()) return ok_status();
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
  return std::fflush(file_.get()) == 0 ? ok_status() : Status(unwritable(path_));
}

}  // namespace nade::xr
