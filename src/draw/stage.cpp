#include "nade/draw/stage.h"

#include <algorithm>
#include <cmath>

#include "object_look.h"
#include "object_shape.h"
#include "stage_diagram.h"
#include "stage_skin.h"

namespace nade::draw {
namespace {

using Vec3f = Eigen::Vector3f;

/// Two hands that are nearer than this look like one; from the second distance on the ghost is
/// as clear as it gets.
constexpr double kGhostFrom = 0.0005;
constexpr double kGhostFull = 0.006;
constexpr float kGhostOpacity = 0.62F;
/// Of that, where it has sunk into the object: which is what it is shown for.
constexpr float kGhostBehind = 0.75F;
/// A flat bottom, or a sheet, does not flicker with the floor.
constexpr double kFloorBelow = 0.0005;
constexpr float kGlassOpacity = 0.48F;
/// A soft object follows skin that lies so much deeper than its softness, and no farther.
constexpr double kDentMore = 0.004;

double farthest_joint(const HandPose& a, const HandPose& b) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    farthest = std::max(farthest, (a.joints[i].position - b.joints[i].position).norm());
  }
  return farthest;
}

/// A hand in the renderer: one that is solid and one like glass.
struct DrawnHand {
  MeshId solid{};
  MeshId ghost{};
  SkinPoser poser;
  SkinPoser ghost_poser;
  SkinFlattener flattener;
  std::vector<Color> own_colors;  ///< of the skin; empty where a texture has them
  bool shows_depth = false;
};

}  // namespace

struct Stage::Impl {
  Renderer* renderer = nullptr;
  HandMeshes hands;
  std::array<std::optional<DrawnHand>, 2> drawn{};
  const LoadedObject* object = nullptr;
  Placement placement;
  std::vector<MeshId> object_meshes;
  ObjectShape shape;
  Weave weave = Weave::coarse;
  std::vector<Vec3f> corners;  ///< of the boxes about the object's meshes, in its own frame
  std::vector<std::string> warnings;
  Scene scene;
  std::vector<Instance> hand_instances;

  ~Impl() {
    clear_object();
    for (const auto& hand : drawn) {
      if (!hand) continue;
      renderer->remove(hand->solid);
      renderer->remove(hand->ghost);
    }
  }

  void clear_object() {
    for (const MeshId mesh : object_meshes) renderer->remove(mesh);
    object_meshes.clear();
    shape.clear();
    corners.clear();
    warnings.clear();
  }

  [[nodiscard]] Status take_object(const LoadedObject& taken, Weave as) {
    Result<DressedObject> dressed = dress(taken, as);
    if (!dressed) return dressed.error();
    clear_object();
    object = &taken;
    weave = as;
    warnings = std::move(dressed->warnings);
    for (const DrawnMesh& mesh : dressed->meshes) {
      object_meshes.push_back(renderer->add(mesh));
      shape.add(object_meshes.back(), mesh);
      Eigen::AlignedBox3f box;
      for (const Vec3f& position : mesh.positions) box.extend(position);
      for (int corner = 0; corner < 8; ++corner) {
        corners.push_back(box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner)));
      }
    }
    return ok_status();
  }

  /// A table top of few triangles could not give way.
  void soften() {
    if (object == nullptr || weave == Weave::fine) return;
    if (dynamic_cast<const PlaneSurface*>(object->surface.get()) == nullptr) return;
    static_cast<void>(take_object(*object, Weave::fine));
  }

  /// Takes a hand to the renderer when it is first shown; null where there is no such mesh.
  DrawnHand* hand_of(std::size_t side) {
    const HandMesh& mesh = hands[side];
    if (mesh.vertices.empty()) return nullptr;
    if (!drawn[side]) {
      DrawnMesh skin = paint_skin(mesh);
      const MeshId solid = renderer->add(skin);
      const MeshId ghost = renderer->add(plain_hand(mesh));
      drawn[side].emplace(DrawnHand{solid, ghost, SkinPoser(mesh), SkinPoser(mesh),
                                    SkinFlattener(mesh), std::move(skin.colors)});
    }
    return &*drawn[side];
  }

  void start_scene() {
    scene.instances.clear();
    scene.lines.clear();
    scene.arrows.clear();
    scene.dots.clear();
    scene.labels.clear();
    hand_instances.clear();
    const Bounds bounds = object_bounds();
    scene.focus = bounds.center;
    scene.focus_radius_m = bounds.radius_m;
  }

  void add_object(Look look) {
    for (const MeshId mesh : object_meshes) {
      Instance instance{mesh, placement};
      instance.look = look;
      if (look == Look::ghost) instance.opacity = kGlassOpacity;
      scene.instances.push_back(instance);
    }
  }

  void add_hand(std::size_t side, const StagedHand& hand, const StageFrame& frame) {
    DrawnHand* const to = hand_of(side);
    if (to == nullptr) return;
    const double scale = hand.scale.value_or(hand_scale(hands[side], hand.tracked));
    const HandPose& solid = frame.shown == Shown::tracked ? hand.tracked : hand.corrected;
    to->poser.pose(solid, scale);
    if (frame.overlays.penetration && object != nullptr) {
      show_depth(*to);
    } else if (to->shows_depth) {
      renderer->set_colors(to->solid, to->own_colors);
      to->shows_depth = false;
    }
    if (hand.method == Method::nade && frame.shown != Shown::tracked && object != nullptr) {
      const double give_m = gives_way(frame) ? frame.softness_m + kDentMore : 0.0;
      to->poser.flatten(to->flattener, object->placed(placement), solid, scale, give_m);
    }
    renderer->set_shape(to->solid, to->poser.positions(), to->poser.normals());
    scene.instances.push_back({to->solid, {}});
    hand_instances.push_back(scene.instances.back());
    if (gives_way(frame) && object != nullptr) {
      shape.press(object->placed(placement), to->poser.positions());
    }
    if (frame.shown == Shown::both) add_ghost(hand, scale, *to);
    add_diagram(hand, frame, scene);
  }

  /// A hand that is not corrected would leave no more than a hole.
  static bool gives_way(const StageFrame& frame) {
    return frame.softness_m > 0.0 && frame.shown != Shown::tracked;
  }

  void show_depth(DrawnHand& hand) {
    std::vector<Color> colors = hand.poser.penetration_colors(object->placed(placement));
    for (std::size_t i = 0; i < hand.own_colors.size(); ++i) {
      colors[i] = colors[i].cwiseProduct(hand.own_colors[i]);
    }
    renderer->set_colors(hand.solid, colors);
    hand.shows_depth = true;
  }

  void add_ghost(const StagedHand& hand, double scale, DrawnHand& to) {
    const double apart = farthest_joint(hand.tracked, hand.corrected);
    if (apart < kGhostFrom) return;
    to.ghost_poser.pose(hand.tracked, scale);
    renderer->set_shape(to.ghost, to.ghost_poser.positions(), to.ghost_poser.normals());
    Instance ghost{to.ghost, {}};
    ghost.look = Look::ghost;
    ghost.tint = diagram_colors().ghost;
    const double clear = std::clamp((apart - kGhostFrom) / (kGhostFull - kGhostFrom), 0.0, 1.0);
    ghost.opacity = kGhostOpacity * static_cast<float>(clear);
    ghost.shows_behind = kGhostBehind;
    scene.instances.push_back(ghost);
  }

  [[nodiscard]] Bounds object_bounds() const {
    if (corners.empty()) return {};
    Eigen::AlignedBox3d box;
    for (const Vec3f& corner : corners) box.extend(placement.to_world(corner.cast<double>()));
    return {box.center(), 0.5 * box.diagonal().norm()};
  }

  void find_floor() {
    scene.floor_y = 0.0;
    if (corners.empty()) return;
    double lowest = placement.to_world(corners.front().cast<double>()).y();
    for (const Vec3f& corner : corners) {
      lowest = std::min(lowest, placement.to_world(corner.cast<double>()).y());
    }
    scene.floor_y = lowest - kFloorBelow;
  }
};

Stage::Stage(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Stage::Stage(Stage&&) noexcept = default;
Stage& Stage::operator=(Stage&&) noexcept = default;
Stage::~Stage() = default;

Result<Stage> Stage::create(Renderer& renderer, const HandMeshes& hands) {
  auto impl = std::make_unique<Impl>();
  impl->renderer = &renderer;
  impl->hands = hands;
  return Stage(std::move(impl));
}

Status Stage::set_object(const LoadedObject& object, const Placement& placement) {
  const Status taken = impl_->take_object(object, Weave::coarse);
  if (!taken) return taken;
  set_placement(placement);
  return ok_status();
}

const std::vector<std::string>& Stage::warnings() const { return impl_->warnings; }

void Stage::set_placement(const Placement& placement) {
  impl_->placement = placement;
  impl_->find_floor();
}

const Scene& Stage::arrange(const StageFrame& frame) {
  if (Impl::gives_way(frame)) impl_->soften();
  impl_->start_scene();
  if (impl_->object != nullptr) impl_->shape.follow(*impl_->object);
  impl_->add_object(frame.overlays.see_through ? Look::ghost : Look::solid);
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (std::size_t side = 0; side < frame.hands.size(); ++side) {
    if (!frame.hands[side]) continue;
    impl_->add_hand(side, *frame.hands[side], frame);
    sum += frame.hands[side]->corrected[Joint::palm].position;
    ++count;
  }
  impl_->shape.update(*impl_->renderer, impl_->placement, frame.softness_m + kDentMore);
  if (count > 0) {
    impl_->scene.focus = sum / count;
    impl_->scene.focus_radius_m = count == 1 ? 0.2 : 0.35;
  }
  // Through glass a shadow would be seen on the floor, far from the skin that casts it.
  impl_->scene.floor = !frame.overlays.see_through;
  return impl_->scene;
}

const Scene& Stage::arrange_object() {
  impl_->start_scene();
  if (impl_->object != nullptr) impl_->shape.follow(*impl_->object);
  impl_->shape.update(*impl_->renderer, impl_->placement, 0.0);
  impl_->add_object(Look::solid);
  impl_->scene.floor = true;
  return impl_->scene;
}

Scene Stage::hand_only() const {
  Scene scene = impl_->scene;
  scene.instances = impl_->hand_instances;
  return scene;
}

Scene Stage::object_only() const {
  Scene scene = impl_->scene;
  scene.instances.clear();
  for (const MeshId mesh : impl_->object_meshes) {
    scene.instances.push_back({mesh, impl_->placement});
  }
  return scene;
}

Stage::Bounds Stage::object_bounds() const { return impl_->object_bounds(); }

}  // namespace nade::draw
