#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nade/corrector.h"
#include "nade/draw/renderer.h"
#include "nade/draw/stage.h"
#include "nade/io/object_file.h"
#include "panel_picture.h"
#include "panel_touch.h"
#include "tracked_frame.h"

namespace nade::xr {

/// What a room is furnished with.
struct RoomSetup {
  draw::HandMeshes hands;
  CorrectorOptions corrector;
  std::vector<std::string> objects;  ///< as `load_object` takes them
  /// Where objects stand, against the spot before the person; without a value the place to stroke
  /// each of them (LoadedObject::place) is at the spot.
  std::optional<Placement> placement;
};

/// What a person is to see and do at the moment.
struct Show {
  std::string object;  ///< one of RoomSetup::objects; empty: none
  Method method = Method::nade;
  draw::Shown shown = draw::Shown::corrected;
  study::PanelView panel;
  bool has_panel = true;
  bool panel_before_person = false;  ///< in the middle instead of beside the object
};

/// Processor time of our own part of a frame, seconds, of the thread that makes it.
struct FrameCost {
  double correct_s = 0.0;  ///< both hands, and moving the object
  double pose_s = 0.0;     ///< the skins, and putting the scene together
  double submit_s = 0.0;   ///< the drawing calls for both eyes
};

/// The virtual room: an object on a stand before the person, their hands, a panel. It knows nothing
/// of OpenXR and lives as long as the OpenGL context it was made in, over lost sessions.
class Room {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Room>> create(RoomSetup setup);
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;
  ~Room();

  /// Changes what is there. Not within a frame's time: it may load and allocate.
  void set(const Show& show);
  [[nodiscard]] const Show& show() const { return show_; }

  /// Puts the object before the person anew, at the next frame that knows the head.
  void recentre() { centred_ = false; }
  void raise(double by_m);
  /// Hands are no longer where they were: a new session.
  void restart();

  /// A new frame: corrects the hands and arranges what will be drawn. Does not allocate, once all
  /// has been seen.
  void update(const TrackedFrame& frame);
  /// Draws the frame for both eyes.
  void draw(const std::array<draw::Sight, 2>& eyes);
  /// As `draw`, into a picture.
  [[nodiscard]] draw::Image picture(const draw::Camera& eye, int width, int height);

  /// The button pressed in the last frame.
  [[nodiscard]] std::optional<int> pressed() const { return pressed_; }
  /// As tracked and corrected in the last frame, in the headset's space.
  struct Hand {
    HandPose tracked;
    CorrectedHand corrected;
  };
  [[nodiscard]] const std::array<std::optional<Hand>, 2>& hands() const { return hands_; }
  /// The spot before the person that objects are placed against, raised or lowered as asked; in the
  /// headset's space.
  [[nodiscard]] Pose object_spot() const;
  /// Where the object stands against the spot.
  [[nodiscard]] Placement placement() const;
  [[nodiscard]] const LoadedObject* object() const;
  /// When the animation of the object began, in the frames' time: at the first frame that showed
  /// the object. No value where it does not move by itself.
  [[nodiscard]] std::optional<std::int64_t> animation_start_ns() const;
  [[nodiscard]] const draw::HandMeshes& meshes() const { return setup_.hands; }
  [[nodiscard]] const CorrectorOptions& corrector() const { return setup_.corrector; }
  [[nodiscard]] Pose panel_pose() const;
  [[nodiscard]] const PanelPicture& panel() const { return panel_; }
  /// Grows with every panel that is another than the last.
  [[nodiscard]] std::uint64_t panel_revision() const { return panel_revision_; }
  [[nodiscard]] const FrameCost& cost() const { return cost_; }

 private:
  /// An object, ready to be shown.
  struct Scenery {
    LoadedObject object;
    std::optional<draw::Stage> stage;
    Placement placement;   ///< against the spot
    draw::MeshId stand{};  ///< what it stands on; under the floor it is not seen
  };

  Room(RoomSetup setup, draw::Renderer renderer);
  [[nodiscard]] Status load(const std::string& spec);
  void paint_panel();
  void find_spot(const TrackedFrame& frame);
  [[nodiscard]] Placement object_placement() const;
  [[nodiscard]] double softness_m() const;
  void animate(const TrackedFrame& frame);
  void correct(const TrackedFrame& frame);
  void touch(const TrackedFrame& frame);
  void arrange(const TrackedFrame& frame);
  void add_stand(double floor_y);
  [[nodiscard]] bool near_object(const HandPose& hand) const;

  RoomSetup setup_;
  draw::Renderer renderer_;
  std::map<std::string, Scenery> sceneries_;
  Scenery* scenery_ = nullptr;
  std::optional<std::int64_t> object_since_ns_;  ///< the first frame that showed it
  std::optional<draw::Stage> bare_;              ///< hands without an object
  Show show_;
  bool centred_ = false;
  Pose spot_;
  double raised_m_ = 0.0;
  std::array<HandCorrector, 2> correctors_;
  std::array<std::optional<Hand>, 2> hands_{};
  std::array<PanelTouch, 2> touches_;
  std::array<Touch, 2> touching_;
  std::optional<int> pressed_;
  PanelPicture panel_;
  std::uint64_t panel_revision_ = 0;
  draw::MeshId panel_mesh_{};
  draw::Scene scene_;
  FrameCost cost_;
};

}  // namespace nade::xr
