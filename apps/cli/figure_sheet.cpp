#include "figure_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "console.h"
#include "nade/draw/camera.h"
#include "nade/draw/text.h"
#include "sheet_canvas.h"

namespace nade::cli {
namespace {

using draw::Color;

constexpr int kWidth = 3840;
constexpr int kMargin = 64;
constexpr int kGap = 24;
constexpr int kRowTitle = 230;
constexpr int kHeader = 190;
constexpr int kLegend = 270;
constexpr double kPanelAspect = 1.16;

const Color kInk(0.015F, 0.02F, 0.03F);
const Color kQuiet(0.12F, 0.14F, 0.17F);

struct Layout {
  int columns = 4;
  int panel_width = 0;
  int panel_height = 0;
  int height = 0;

  Layout(std::size_t methods, std::size_t rows) : columns(static_cast<int>(methods) + 3) {
    panel_width = (kWidth - 2 * kMargin - kRowTitle - kGap * (columns - 1)) / columns;
    panel_height = static_cast<int>(panel_width / kPanelAspect);
    height = kMargin + kHeader + static_cast<int>(rows) * (panel_height + kGap) + kLegend;
  }
  [[nodiscard]] int left(int column) const {
    return kMargin + kRowTitle + column * (panel_width + kGap);
  }
  [[nodiscard]] int top(int row) const { return kMargin + kHeader + row * (panel_height + kGap); }
  [[nodiscard]] float middle(int column) const {
    return static_cast<float>(left(column)) + 0.5F * static_cast<float>(panel_width);
  }
};

/// A ball about hands.
struct Ball {
  Vec3 center = Vec3::Zero();
  double radius_m = 0.1;
};

Ball ball_about(const std::vector<draw::StagedHands>& moments) {
  Eigen::AlignedBox3d box;
  for (const draw::StagedHands& hands : moments) {
    for (const auto& hand : hands) {
      if (!hand) continue;
      for (const Pose& joint : hand->tracked.joints) box.extend(joint.position);
      for (const Pose& joint : hand->corrected.joints) box.extend(joint.position);
    }
  }
  if (box.isEmpty()) return {};
  return {box.center(), 0.5 * box.diagonal().norm()};
}

const draw::StagedHand* first_hand(const draw::StagedHands& hands) {
  for (const std::size_t side : {index_of(Handedness::right), index_of(Handedness::left)}) {
    if (hands[side]) return &*hands[side];
  }
  return nullptr;
}

/// From the thumb's side, a little ahead of the hand and above the surface: there it can be seen
/// what sinks in and what rests.
draw::Camera hand_camera(const FigureRow& row) {
  const Ball ball = ball_about(row.by_method);
  const draw::StagedHand* const hand = first_hand(row.by_method.front());
  Vec3 ahead = -Vec3::UnitZ();
  Vec3 thumb = -Vec3::UnitX();
  if (hand != nullptr) {
    const Quat& palm = hand->tracked[Joint::palm].rotation;
    ahead = palm * -Vec3::UnitZ();
    thumb = palm * Vec3(hand->tracked.side == Handedness::right ? -1.0 : 1.0, 0.0, 0.0);
  }
  constexpr double kAhead = 28.0 * kDegree;
  constexpr double kAbove = 17.0 * kDegree;
  constexpr double kView = 24.0 * kDegree;
  Vec3 out = std::cos(kAhead) * thumb + std::sin(kAhead) * ahead;
  out.y() = 0.0;
  out = out.norm() > 1e-6 ? Vec3(out.normalized()) : Vec3::UnitZ();
  out = std::cos(kAbove) * out + std::sin(kAbove) * Vec3::UnitY();
  const double distance = row.air * ball.radius_m / std::sin(0.5 * kView);
  return draw::looking_at(ball.center + distance * out, ball.center, kView, kPanelAspect);
}

draw::Camera object_camera(const draw::Stage& stage) {
  const draw::Stage::Bounds bounds = stage.object_bounds();
  return draw::framed(draw::View::three_quarter, bounds.center, 0.82 * bounds.radius_m)
      .camera(kPanelAspect);
}

/// What stands before a row.
struct Title {
  std::string text;
  float height_px = 62.0F;
};

/// Within the space before the pictures: as long a title as can be in small letters, then cut.
Title fitted(const std::string& text) {
  constexpr auto kRoom = static_cast<float>(kRowTitle - kGap);
  constexpr float kSmallest = 36.0F;
  Title title{text};
  const float width = draw::text_width(text, title.height_px);
  if (width <= kRoom) return title;
  // Letters of another size are not exactly as much wider.
  title.height_px = std::max(kSmallest, 0.97F * title.height_px * kRoom / width);
  std::string kept = text;
  while (!kept.empty() && draw::text_width(title.text, title.height_px) > kRoom) {
    // A letter of UTF-8 goes whole.
    while (kept.size() > 1 && (static_cast<unsigned char>(kept.back()) & 0xC0U) == 0x80U) {
      kept.pop_back();
    }
    kept.pop_back();
    title.text = kept + "…";
  }
  return title;
}

class Sheet {
 public:
  Sheet(const FigureContent& content, Studio& studio)
      : content_(content),
        studio_(studio),
        layout_(content.methods.size(), content.rows.size()),
        canvas_(kWidth, layout_.height),
        progress_("drew panels:", content.rows.size() * (content.methods.size() + 3)) {}

  Result<draw::Image> draw() {
    draw_headers();
    for (std::size_t row = 0; row < content_.rows.size(); ++row) {
      const Status drawn = draw_row(static_cast<int>(row), content_.rows[row]);
      if (!drawn) return drawn.error();
    }
    draw_legend();
    return canvas_.image();
  }

 private:
  void draw_header(int column, const std::string& number, const std::string& title,
                   const std::string& subtitle) {
    canvas_.centered({layout_.middle(column), kMargin + 4.0F}, number + "  " + title, 62.0F, kInk);
    canvas_.centered({layout_.middle(column), kMargin + 96.0F}, subtitle, 38.0F, kQuiet);
  }

  void draw_headers() {
    draw_header(0, "(i)", "Object", "what is stroked");
    draw_header(1, "(ii)", "Without correction", "the tracked hand sinks in");
    const auto methods = static_cast<int>(content_.methods.size());
    for (int m = 0; m < methods; ++m) {
      const std::string& name = content_.methods[static_cast<std::size_t>(m)];
      draw_header(2 + m, "(iii)", methods == 1 ? "With correction" : "Corrected: " + name,
                  methods == 1 ? fmt::format("the hand that is drawn (method {})", name)
                               : "the hand that is drawn");
    }
    const std::string& explained = content_.methods[content_.explained];
    draw_header(2 + methods, "(iv)", "Explained",
                methods == 1 ? "how the one becomes the other"
                             : fmt::format("how the tracked hand becomes {}'s", explained));
  }

  Status draw_row(int index, const FigureRow& row) {
    const Status set = set_object(studio_, row.placed);
    if (!set) return set;
    const float middle =
        static_cast<float>(layout_.top(index)) + 0.5F * static_cast<float>(layout_.panel_height);
    const Title title = fitted(row.title);
    canvas_.text({static_cast<float>(kMargin), middle - 0.58F * title.height_px}, title.text,
                 title.height_px, kInk);
    paste(index, 0, take(studio_.stage.arrange_object(), object_camera(studio_.stage)));
    const draw::Camera camera = hand_camera(row);
    draw::StageFrame frame;
    frame.pixel_scale = 1.7F;
    frame.hands = row.by_method.front();
    frame.shown = draw::Shown::tracked;
    paste(index, 1, take(studio_.stage.arrange(frame), camera));
    frame.shown = draw::Shown::corrected;
    for (std::size_t m = 0; m < row.by_method.size(); ++m) {
      frame.hands = row.by_method[m];
      paste(index, 2 + static_cast<int>(m), take(studio_.stage.arrange(frame), camera));
    }
    frame.hands = row.by_method[content_.explained];
    frame.shown = draw::Shown::both;
    frame.overlays.rays = frame.overlays.contacts = frame.overlays.normals = true;
    frame.overlays.held_ray = false;
    frame.overlays.see_through = true;
    paste(index, layout_.columns - 1, take(studio_.stage.arrange(frame), camera));
    return ok_status();
  }

  draw::Image take(const draw::Scene& scene, const draw::Camera& camera) {
    progress_.step();
    return studio_.renderer->picture(scene, camera, layout_.panel_width, layout_.panel_height);
  }

  void paste(int row, int column, const draw::Image& picture) {
    canvas_.paste(picture, layout_.left(column), layout_.top(row));
  }

  /// One sign of the legend and what it means; where the next may begin.
  template <class Sign>
  float draw_entry(float x, float y, const std::string& meaning, const Sign& sign) {
    sign(x, y + 26.0F);
    canvas_.text({x + 104.0F, y}, meaning, 40.0F, kInk);
    return x + 104.0F + draw::text_width(meaning, 40.0F) + 64.0F;
  }

  void draw_legend() {
    const draw::DiagramColors colors = draw::diagram_colors();
    const auto top = static_cast<float>(layout_.top(static_cast<int>(content_.rows.size())));
    const auto first = static_cast<float>(kMargin + kRowTitle);
    const auto dot = [this](const Color& color) {
      return [this, color](float x, float y) { canvas_.disc({x + 44.0F, y}, 17.0F, color); };
    };
    const auto arrow = [this](const Color& color, float width) {
      return [this, color, width](float x, float y) {
        canvas_.arrow({x + 4.0F, y}, {x + 84.0F, y}, width, color);
      };
    };
    const bool rays = content_.terms == FigureTerms::rays;
    float y = top + 24.0F;
    canvas_.text({static_cast<float>(kMargin), y}, "In (iv)", 44.0F, kInk);
    float x = draw_entry(first, y, "tracked hand", [&](float at_x, float at_y) {
      canvas_.line({at_x + 18.0F, at_y}, {at_x + 72.0F, at_y}, 34.0F, colors.ghost);
    });
    x = draw_entry(
        x, y,
        rays ? "a part's tracked skin, where its ray starts" : "a part's tracked skin, sunk in",
        dot(colors.start));
    x = draw_entry(x, y, rays ? "ray out along the back of the hand" : "its way to where it rests",
                   [&](float at_x, float at_y) {
                     canvas_.line({at_x + 4.0F, at_y}, {at_x + 84.0F, at_y}, 8.0F, colors.ray);
                   });
    draw_entry(x, y, rays ? "s, where it meets the surface" : "s, the surface there",
               dot(colors.surface_point));
    y += 74.0F;
    x = draw_entry(first, y, rays ? "p_vr, where the part belongs" : "the part's joint, as drawn",
                   dot(colors.target));
    x = draw_entry(x, y, "n, the surface's normal there", arrow(colors.normal, 7.0F));
    draw_entry(x, y,
               rays ? "b, the back of the hand, which the palm's turn takes to n"
                    : "b, the back of the hand, as drawn",
               arrow(colors.back, 9.0F));
    canvas_.text({first, y + 86.0F}, content_.caption, 36.0F, kQuiet);
  }

  const FigureContent& content_;
  Studio& studio_;
  Layout layout_;
  SheetCanvas canvas_;
  Progress progress_;
};

}  // namespace

Result<draw::Image> draw_figure(const FigureContent& content, Studio& studio) {
  return Sheet(content, studio).draw();
}

}  // namespace nade::cli
