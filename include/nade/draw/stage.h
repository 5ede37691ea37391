#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nade/corrector.h"
#include "nade/draw/renderer.h"
#include "nade/hand_mesh.h"
#include "nade/io/object_file.h"

namespace nade::draw {

/// What is shown of a hand.
enum class Shown : std::uint8_t { tracked, corrected, both };

/// Diagram parts on demand.
struct Overlays {
  bool rays = false;         ///< from the tracked parts to the surface
  bool contacts = false;     ///< surface points and where the parts go, p_vr
  bool normals = false;      ///< of the surface at the contacts, and the back of the hand
  bool held_ray = false;     ///< the palm's, as held since it went in
  bool penetration = false;  ///< colour on the skin, by depth
  bool labels = false;       ///< the names of all these
  bool see_through = false;  ///< the object like glass, to see what is in it
};

/// One hand of a frame, as tracked and as corrected. `contacts` only where the correction was
/// made here or was recorded.
struct StagedHand {
  HandPose tracked;
  HandPose corrected;
  Contacts contacts{};
  /// Of the skin against its mesh; without a value this tracked hand's `hand_scale`.
  std::optional<double> scale;
  /// By which it was corrected. Skin of `Method::nade` is drawn flattened where it is sunk in the
  /// object; that of other methods, and of the tracked hand, as it is posed.
  Method method = Method::none;
};

/// By index_of(Handedness).
using StagedHands = std::array<std::optional<StagedHand>, 2>;

/// Everything to be shown at one moment.
struct StageFrame {
  StagedHands hands{};
  Shown shown = Shown::corrected;  ///< both: the tracked hand as a ghost
  Overlays overlays;
  /// Of the object, metres: it gives way to corrected skin that lies in it by about so much.
  double softness_m = 0.0;
  float pixel_scale = 1.0F;  ///< of line widths and labels, for pictures larger than a screen
};

/// What the diagram parts are coloured, for legends.
struct DiagramColors {
  Color ray;
  Color held_ray;
  Color start;          ///< of a ray: the tracked skin of the part
  Color surface_point;  ///< s_j
  Color target;         ///< p_vr_j
  Color normal;
  Color back;  ///< b
  Color ghost;
};
[[nodiscard]] DiagramColors diagram_colors();

/// The hands that are drawn, left and right.
using HandMeshes = std::array<HandMesh, 2>;

/// An object and hands, dressed, lit and put into a renderer.
class Stage {
 public:
  /// `renderer` must outlive the stage.
  [[nodiscard]] static Result<Stage> create(Renderer& renderer, const HandMeshes& hands);
  Stage(Stage&&) noexcept;
  Stage& operator=(Stage&&) noexcept;
  ~Stage();

  /// Shows another object. Mesh files come with their materials and textures. `object` must
  /// outlive the stage or the next call; where it is moved on in between, the next scene shows it
  /// so.
  [[nodiscard]] Status set_object(const LoadedObject& object, const Placement& placement);
  /// What of the object could not be shown as its file says, a sentence each.
  [[nodiscard]] const std::vector<std::string>& warnings() const;
  /// Moves the object that is shown.
  void set_placement(const Placement& placement);

  /// The frame as a scene, valid until the next call; the hands' skins are posed in the renderer.
  [[nodiscard]] const Scene& arrange(const StageFrame& frame);
  /// The object alone.
  [[nodiscard]] const Scene& arrange_object();
  /// Only what touches: the hand's and the object's instances, for depth maps.
  [[nodiscard]] Scene hand_only() const;
  [[nodiscard]] Scene object_only() const;

  /// A ball about the object where it stands.
  struct Bounds {
    Vec3 center = Vec3::Zero();
    double radius_m = 0.2;
  };
  [[nodiscard]] Bounds object_bounds() const;

 private:
  struct Impl;
  explicit Stage(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace nade::draw
