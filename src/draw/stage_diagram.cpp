#include "stage_diagram.h"

#include <string>

#include "object_look.h"

namespace nade::draw {
namespace {

constexpr double kNormalLength = 0.032;
constexpr double kBackLength = 0.055;
/// How far the held ray is drawn past the surface.
constexpr double kRayPast = 0.05;

class Diagram {
 public:
  Diagram(const StagedHand& hand, const StageFrame& frame, Scene& scene)
      : hand_(hand), asked_(frame.overlays), scene_(scene), pixels_(frame.pixel_scale) {}

  void add_part(Part part) {
    const auto& contact = hand_.contacts[index_of(part)];
    if (!contact) return;
    if (asked_.rays) add_ray(*contact);
    if (asked_.held_ray && part == Part::palm) add_held_ray(*contact);
    if (asked_.contacts) {
      scene_.dots.push_back({contact->surface_point, colors_.surface_point, 0.0028F});
      scene_.dots.push_back({contact->target, colors_.target, 0.0036F});
    }
    if (asked_.normals) {
      scene_.arrows.push_back({contact->surface_point,
                               contact->surface_point + kNormalLength * contact->normal,
                               colors_.normal, 0.0009F});
    }
    if (asked_.labels) label_part(part, *contact);
  }

  /// The back of the hand, as it is shown.
  void add_back(const HandPose& hand) {
    if (!asked_.normals) return;
    const Vec3 from = hand[Joint::palm].position;
    const Vec3 to = from + kBackLength * hand.back();
    scene_.arrows.push_back({from, to, colors_.back, 0.0016F});
    if (asked_.labels) add_label(to, "b", colors_.back);
  }

 private:
  void add_ray(const PartContact& contact) {
    scene_.lines.push_back(
        {contact.ray_origin, contact.surface_point, colors_.ray, 3.0F * pixels_});
    scene_.dots.push_back({contact.ray_origin, colors_.start, 0.0028F});
  }

  void add_held_ray(const PartContact& contact) {
    const Vec3 along = contact.ray_direction;
    const double length = (contact.surface_point - contact.ray_origin).dot(along) + kRayPast;
    const Vec3 to = contact.ray_origin + length * along;
    scene_.arrows.push_back({contact.ray_origin, to, colors_.held_ray, 0.0011F});
    if (asked_.labels) add_label(to, "held ray", colors_.held_ray);
  }

  void label_part(Part part, const PartContact& contact) {
    if (part != Part::palm) {
      add_label(contact.target, std::string(nade::name_of(part)), colors_.target);
      return;
    }
    if (asked_.rays) add_label(contact.ray_origin, "p", colors_.start);
    if (asked_.contacts) {
      add_label(contact.surface_point, "s", colors_.surface_point);
      add_label(contact.target, "p_vr", colors_.target);
    }
    if (asked_.normals) {
      add_label(contact.surface_point + kNormalLength * contact.normal, "n", colors_.normal);
    }
  }

  void add_label(const Vec3& at, std::string text, const Color& color) {
    Label label{at, std::move(text), color};
    label.height_px *= pixels_;
    label.offset_px *= pixels_;
    scene_.labels.push_back(std::move(label));
  }

  const StagedHand& hand_;
  const Overlays& asked_;
  Scene& scene_;
  float pixels_;
  DiagramColors colors_ = diagram_colors();
};

}  // namespace

// Based on: Okabe, Ito. Color Universal Design. 2008 (the palette).
DiagramColors diagram_colors() {
  return {from_srgb({0.90F, 0.62F, 0.00F}), from_srgb({0.93F, 0.35F, 0.62F}),
          from_srgb({0.84F, 0.37F, 0.00F}), from_srgb({0.98F, 0.90F, 0.20F}),
          from_srgb({0.00F, 0.68F, 0.42F}), from_srgb({0.00F, 0.40F, 0.80F}),
          from_srgb({0.55F, 0.20F, 0.65F}), from_srgb({0.38F, 0.62F, 0.98F})};
}

void add_diagram(const StagedHand& hand, const StageFrame& frame, Scene& scene) {
  Diagram diagram(hand, frame, scene);
  for (std::size_t i = 0; i < kPartCount; ++i) diagram.add_part(part_at(i));
  diagram.add_back(frame.shown == Shown::tracked ? hand.tracked : hand.corrected);
}

}  // namespace nade::draw
