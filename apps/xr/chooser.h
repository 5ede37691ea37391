#pragma once

#include <string>
#include <vector>

#include "guide.h"

namespace nade::xr {

/// Lets the person choose: object, method, what is shown, where it stands.
class Chooser final : public Guide {
 public:
  struct Setup {
    std::vector<std::string> objects;  ///< as in RoomSetup; the first one is shown first
    Method method = Method::nade;
    draw::Shown shown = draw::Shown::corrected;
    bool show_time = false;
  };
  explicit Chooser(Setup setup);

  [[nodiscard]] const Show& show() override { return show_; }
  [[nodiscard]] bool changed() override;
  void press(int button) override;
  void seen(const Moment& moment) override;
  [[nodiscard]] Wishes take_wishes() override;

 private:
  void rebuild();

  Setup setup_;
  Show show_;
  bool changed_ = true;
  Wishes wishes_;
  double time_us_ = 0.0;
  std::int64_t time_told_ns_ = 0;
};

/// "sphere", "bunny": an object's name without folders and ending.
[[nodiscard]] std::string short_name(const std::string& object);
/// Of each object its short name, or as much more as tells it from the others.
[[nodiscard]] std::vector<std::string> button_names(const std::vector<std::string>& objects);

}  // namespace nade::xr
