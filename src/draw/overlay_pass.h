#pragma once

#include <array>
#include <vector>

#include "gl_objects.h"
#include "nade/draw/scene.h"

namespace nade::draw {

/// One line, arrow or dot as the shaders take it.
struct OverlayPart {
  std::array<float, 3> from{};
  std::array<float, 3> to{};
  std::array<float, 3> color{};
  float size = 0.0F;  ///< width in pixels, or radius in metres
};

/// Lines, arrows and dots: full where nothing stands before them, else faint.
class OverlayPass {
 public:
  [[nodiscard]] static Result<OverlayPass> create();
  void draw(const Scene& scene);

 private:
  /// A solid that is one profile turned about an axis.
  struct Revolved {
    GlBuffer vertices;
    GlVertexArray layout;
    GLsizei count = 0;
  };
  OverlayPass() = default;
  [[nodiscard]] Revolved make_revolved(const std::vector<std::array<float, 5>>& profile) const;
  void gather(const Scene& scene);
  void draw_all(const Scene& scene);

  GlProgram line_program_;
  GlProgram solid_program_;
  GlBuffer parts_;
  std::size_t room_ = 0;
  GlVertexArray line_layout_;
  Revolved arrow_;
  Revolved dot_;
  std::vector<OverlayPart> gathered_;
};

}  // namespace nade::draw
