#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "frame_uniforms.h"
#include "gl_objects.h"
#include "glyphs.h"

namespace nade::draw {

/// Labels, on top of everything, each with a halo that parts it from what is behind.
class LabelPass {
 public:
  [[nodiscard]] static Result<LabelPass> create();
  void draw(const std::vector<Label>& labels, const FrameUniforms& frame);

 private:
  /// A glyph's place in the atlas and about the pen; pixels.
  struct StoredGlyph {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    int left = 0;
    int top = 0;
  };
  struct Key {
    int glyph;
    int quarter_height;  ///< four times the height
    friend bool operator<(const Key& a, const Key& b) {
      return std::tie(a.glyph, a.quarter_height) < std::tie(b.glyph, b.quarter_height);
    }
  };
  struct Quad {
    std::array<float, 4> place;  ///< left, top, width, height in the picture; pixels
    std::array<float, 2> atlas;  ///< left, top
    std::array<float, 3> color;
  };
  LabelPass() = default;
  /// No value where the atlas is full.
  [[nodiscard]] std::optional<StoredGlyph> stored(const Key& key);
  /// False where the atlas was full.
  [[nodiscard]] bool lay_out(const std::vector<Label>& labels, const FrameUniforms& frame);
  [[nodiscard]] bool lay_out(const Label& label, const FrameUniforms& frame);
  void forget_glyphs();

  GlProgram program_;
  GlTexture atlas_;
  GlVertexArray layout_;
  GlBuffer quads_;
  std::size_t room_ = 0;
  std::map<Key, StoredGlyph> glyphs_;
  int shelf_x_ = 0;
  int shelf_y_ = 0;
  int shelf_height_ = 0;
  std::vector<Quad> laid_out_;
  TextLine line_;
};

}  // namespace nade::draw
