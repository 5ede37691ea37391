#include "room.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "thread_clock.h"

namespace nade::xr {
namespace {

/// The spot: where a surface to stroke is at hand, from the eyes.
constexpr double kAhead_m = 0.40;
constexpr double kBelow_m = 0.42;
/// The panel, from the spot: beside the object, or in the middle.
const Vec3 kPanelBeside(-0.36, 0.16, -0.06);
const Vec3 kPanelBefore(0.0, 0.20, -0.06);
constexpr double kPanelTurn_rad = 0.6;
constexpr double kPanelTilt_rad = -0.35;
/// Nearer to the object than this a hand strokes and does not point.
constexpr double kAtObject_m = 0.08;
constexpr float kStandHeight_m = 1.2F;
constexpr double kStandThinnest_m = 0.10;
constexpr double kStandThickest_m = 0.45;
constexpr float kCursor_m = 0.004F;
const draw::Color kCursorColor(0.02F, 0.10F, 0.45F);

Quat about(const Vec3& axis, double angle_rad) { return Quat(Eigen::AngleAxisd(angle_rad, axis)); }

draw::DrawnMesh panel_mesh() {
  constexpr auto kHalfX = static_cast<float>(0.5 * kPanelWidth_m);
  constexpr auto kHalfY = static_cast<float>(0.5 * kPanelHeight_m);
  draw::DrawnMesh mesh;
  mesh.positions = {{-kHalfX, -kHalfY, 0.0F},
                    {kHalfX, -kHalfY, 0.0F},
                    {kHalfX, kHalfY, 0.0F},
                    {-kHalfX, kHalfY, 0.0F}};
  mesh.normals.assign(4, Eigen::Vector3f::UnitZ());
  mesh.texcoords = {{0.0F, 1.0F}, {1.0F, 1.0F}, {1.0F, 0.0F}, {0.0F, 0.0F}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.material.base_color = draw::Color(0.9F, 0.9F, 0.9F);
  mesh.material.roughness = 0.95F;
  mesh.texture = std::make_shared<draw::Image>(draw::Image::blank(kPanelWidth_px, kPanelHeight_px));
  return mesh;
}

/// A column, its top about the origin.
draw::DrawnMesh stand_mesh(float radius_m) {
  constexpr int kAround = 48;
  draw::DrawnMesh mesh;
  const auto add = [&mesh](float x, float y, float z, const Eigen::Vector3f& normal) {
    mesh.positions.emplace_back(x, y, z);
    mesh.normals.push_back(normal);
  };
  add(0.0F, 0.0F, 0.0F, Eigen::Vector3f::UnitY());
  for (int i = 0; i < kAround; ++i) {
    const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / kAround;
    const float x = radius_m * std::sin(angle);
    const float z = radius_m * std::cos(angle);
    const Eigen::Vector3f out = Eigen::Vector3f(x, 0.0F, z).normalized();
    add(x, 0.0F, z, Eigen::Vector3f::UnitY());
    add(x, 0.0F, z, out);
    add(x, -kStandHeight_m, z, out);
  }
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const std::uint32_t a = 1 + 3 * i;
    const std::uint32_t b = 1 + 3 * ((i + 1) % kAround);
    mesh.triangles.push_back({0, a, b});
    mesh.triangles.push_back({a + 1, a + 2, b + 2});
    mesh.triangles.push_back({a + 1, b + 2, b + 1});
  }
  mesh.material.base_color = draw::Color(0.32F, 0.30F, 0.28F);
  mesh.material.roughness = 0.8F;
  return mesh;
}

bool same(const study::PanelView& a, const study::PanelView& b) {
  const auto same_button = [](const study::PanelButton& x, const study::PanelButton& y) {
    return x.id == y.id && x.label == y.label && x.chosen == y.chosen && x.enabled == y.enabled;
  };
  const auto same_row = [&](const auto& x, const auto& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(), same_button);
  };
  return a.heading == b.heading && a.lines == b.lines &&
         std::equal(a.rows.begin(), a.rows.end(), b.rows.begin(), b.rows.end(), same_row);
}

}  // namespace

Room::Room(RoomSetup setup, draw::Renderer renderer)
    : setup_(std::move(setup)),
      renderer_(std::move(renderer)),
      correctors_{HandCorrector(setup_.corrector), HandCorrector(setup_.corrector)} {
  show_.method = setup_.corrector.method;
}

Room::~Room() = default;

Result<std::unique_ptr<Room>> Room::create(RoomSetup setup) {
  Result<draw::Renderer> renderer = draw::Renderer::create();
  if (!renderer) return renderer.error();
  std::unique_ptr<Room> room(new Room(std::move(setup), std::move(renderer).value()));
  Result<draw::Stage> bare = draw::Stage::create(room->renderer_, room->setup_.hands);
  if (!bare) return bare.error();
  room->bare_.emplace(std::move(bare).value());
  for (const std::string& spec : room->setup_.objects) {
    if (Status loaded = room->load(spec); !loaded) return loaded.error();
  }
  room->panel_mesh_ = room->renderer_.add(panel_mesh());
  room->paint_panel();
  return room;
}

Status Room::load(const std::string& spec) {
  if (sceneries_.count(spec) != 0) return ok_status();
  Result<LoadedObject> object = load_object(spec);
  if (!object) return object.error();
  Result<draw::Stage> stage = draw::Stage::create(renderer_, setup_.hands);
  if (!stage) return stage.error();
  Scenery& scenery = sceneries_[spec];
  scenery.object = std::move(object).value();
  scenery.stage.emplace(std::move(stage).value());
  if (setup_.placement) {
    scenery.placement = *setup_.placement;
  } else if (const Result<MeshPlace> place = scenery.object.place(); place.ok()) {
    scenery.placement.pose.position = -place->pose.position;
  }
  if (Status set = scenery.stage->set_object(scenery.object, scenery.placement); !set) return set;
  // As wide as what it bears, more or less.
  const double radius_m =
      std::clamp(0.6 * scenery.stage->object_bounds().radius_m, kStandThinnest_m, kStandThickest_m);
  scenery.stand = renderer_.add(stand_mesh(static_cast<float>(radius_m)));
  // Takes the hands to the graphics card now and not in the first frame that shows them.
  draw::StageFrame frame;
  for (std::size_t side = 0; side < 2; ++side) {
    if (setup_.hands[side].vertices.empty()) continue;
    frame.hands[side] = {setup_.hands[side].bind, setup_.hands[side].bind, {}, {}};
  }
  frame.shown = draw::Shown::both;
  frame.softness_m = setup_.corrector.settle.softness_m;
  static_cast<void>(scenery.stage->arrange(frame));
  return ok_status();
}

const LoadedObject* Room::object() const {
  return scenery_ == nullptr ? nullptr : &scenery_->object;
}

std::optional<std::int64_t> Room::animation_start_ns() const {
  const bool moves = scenery_ != nullptr && scenery_->object.animation;
  return moves ? object_since_ns_ : std::nullopt;
}

void Room::set(const Show& show) {
  const bool other_object = show.object != show_.object || scenery_ == nullptr;
  const bool other_method = show.method != show_.method;
  const bool other_panel = !same(show.panel, show_.panel);
  show_ = show;
  if (other_object) {
    const auto found = sceneries_.find(show_.object);
    scenery_ = found == sceneries_.end() ? nullptr : &found->second;
    object_since_ns_.reset();
  }
  if (other_method) {
    setup_.corrector.method = show_.method;
    for (HandCorrector& corrector : correctors_) corrector = HandCorrector(setup_.corrector);
  } else if (other_object) {
    for (HandCorrector& corrector : correctors_) corrector.reset();
  }
  if (other_panel) paint_panel();
}

void Room::paint_panel() {
  panel_ = paint(show_.panel);
  ++panel_revision_;
  renderer_.set_texture(panel_mesh_, panel_.image);
}

void Room::raise(double by_m) { raised_m_ = std::clamp(raised_m_ + by_m, -0.5, 0.5); }

void Room::restart() {
  for (HandCorrector& corrector : correctors_) corrector.reset();
  touches_ = {};
  hands_ = {};
}

void Room::find_spot(const TrackedFrame& frame) {
  if (centred_ || !frame.head) return;
  Vec3 ahead = frame.head->rotation * -Vec3::UnitZ();
  ahead.y() = 0.0;
  if (ahead.norm() < 0.1) return;  // looks straight up or down
  ahead.normalize();
  spot_.position = frame.head->position + kAhead_m * ahead - kBelow_m * Vec3::UnitY();
  spot_.rotation = about(Vec3::UnitY(), std::atan2(-ahead.x(), -ahead.z()));
  raised_m_ = 0.0;
  centred_ = true;
}

Pose Room::object_spot() const {
  Pose spot = spot_;
  spot.position.y() += raised_m_;
  return spot;
}

Placement Room::object_placement() const { return composed({object_spot(), 1.0}, placement()); }

Placement Room::placement() const {
  return scenery_ == nullptr ? Placement{} : scenery_->placement;
}

Pose Room::panel_pose() const {
  const bool before = show_.panel_before_person;
  const Quat turn = before ? Quat(Quat::Identity()) : about(Vec3::UnitY(), kPanelTurn_rad);
  const Pose local{before ? kPanelBefore : kPanelBeside,
                   turn * about(Vec3::UnitX(), kPanelTilt_rad)};
  return spot_ * local;
}

/// Of the object as it is drawn: the other methods know nothing of it.
double Room::softness_m() const {
  return show_.method == Method::nade ? setup_.corrector.settle.softness_m : 0.0;
}

void Room::animate(const TrackedFrame& frame) {
  if (scenery_ == nullptr) return;
  if (!object_since_ns_) object_since_ns_ = frame.time_ns;
  scenery_->object.move_to(1e-9 * static_cast<double>(frame.time_ns - *object_since_ns_));
}

void Room::correct(const TrackedFrame& frame) {
  const std::optional<Object> object =
      scenery_ == nullptr ? std::nullopt
                          : std::optional(scenery_->object.placed(object_placement()));
  for (std::size_t side = 0; side < 2; ++side) {
    const std::optional<HandPose>& tracked = frame.hands[side];
    if (!tracked) {
      hands_[side].reset();
      continue;
    }
    if (!hands_[side]) hands_[side].emplace();
    hands_[side]->tracked = *tracked;
    if (object) {
      hands_[side]->corrected = correctors_[side].update(*tracked, *object, frame.time_ns);
    } else {
      hands_[side]->corrected = {};
      hands_[side]->corrected.pose = *tracked;
      hands_[side]->corrected.status = HandStatus::free;
    }
  }
}

bool Room::near_object(const HandPose& hand) const {
  if (scenery_ == nullptr) return false;
  SurfaceHint hint;
  const Object object = scenery_->object.placed(object_placement());
  const auto near = object.closest_point(hand[Joint::palm].position, kAtObject_m, hint);
  return near.has_value();
}

void Room::touch(const TrackedFrame& frame) {
  pressed_.reset();
  for (std::size_t side = 0; side < 2; ++side) {
    touching_[side] = {};
    if (!show_.has_panel || !frame.focused) {
      touches_[side] = {};
      continue;
    }
    const std::optional<HandPose>& hand = frame.hands[side];
    touching_[side] =
        touches_[side].update(hand, frame.head, panel_pose(), panel_, hand && !near_object(*hand));
    if (touching_[side].pressed) pressed_ = touching_[side].pressed;
  }
}

void Room::add_stand(double floor_y) {
  const draw::Stage::Bounds bounds = scenery_->stage->object_bounds();
  const double top = scene_.floor_y;  // as the stage has it: the object's lowest
  if (top - floor_y < 0.05) return;
  draw::Instance stand{scenery_->stand, {}};
  stand.placement.pose.position = Vec3(bounds.center.x(), top, bounds.center.z());
  scene_.instances.push_back(stand);
}

void Room::arrange(const TrackedFrame& frame) {
  draw::StageFrame staged;
  staged.shown = show_.shown;
  staged.softness_m = softness_m();
  for (std::size_t side = 0; side < 2; ++side) {
    if (!hands_[side]) continue;
    staged.hands[side].emplace();
    staged.hands[side]->tracked = hands_[side]->tracked;
    staged.hands[side]->corrected = hands_[side]->corrected.pose;
    staged.hands[side]->contacts = hands_[side]->corrected.contacts;
    staged.hands[side]->method = show_.method;
  }
  if (scenery_ != nullptr) {
    scenery_->stage->set_placement(object_placement());
    scene_ = scenery_->stage->arrange(staged);
    add_stand(frame.floor_y);
  } else {
    scene_ = bare_->arrange(staged);
  }
  scene_.floor_y = frame.floor_y;
  const Vec3 ahead = spot_.rotation * -Vec3::UnitZ();
  scene_.light_turn_rad = std::atan2(-ahead.x(), -ahead.z());
  if (!show_.has_panel) return;
  scene_.instances.push_back({panel_mesh_, {panel_pose(), 1.0}});
  for (const Touch& touch : touching_) {
    if (touch.cursor) scene_.dots.push_back({*touch.cursor, kCursorColor, kCursor_m});
    if (touch.cursor && touch.ray_from) {
      scene_.lines.push_back({*touch.ray_from, *touch.cursor, kCursorColor, 2.0F});
    }
  }
}

void Room::update(const TrackedFrame& frame) {
  find_spot(frame);
  const double start = thread_seconds();
  animate(frame);
  correct(frame);
  const double corrected = thread_seconds();
  touch(frame);
  arrange(frame);
  cost_.correct_s = corrected - start;
  cost_.pose_s = thread_seconds() - corrected;
  cost_.submit_s = 0.0;
}

void Room::draw(const std::array<draw::Sight, 2>& eyes) {
  const double start = thread_seconds();
  renderer_.draw(scene_, eyes);
  cost_.submit_s = thread_seconds() - start;
}

draw::Image Room::picture(const draw::Camera& eye, int width, int height) {
  return renderer_.picture(scene_, eye, width, height);
}

}  // namespace nade::xr
