#include "label_pass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nade::draw {
namespace {

constexpr int kAtlasSize = 1024;
constexpr GLuint kAtlasUnit = 0;
constexpr float kTallest = 200.0F;

int halo_px(float height_px) {
  return std::max(2, static_cast<int>(std::lround(0.11F * height_px)));
}

/// Cover and halo of each pixel, with room for the halo all about.
std::vector<std::uint8_t> with_halo(const GlyphBitmap& glyph, int halo) {
  const int width = glyph.width + 2 * halo;
  const int height = glyph.height + 2 * halo;
  std::vector<std::uint8_t> both(2 * static_cast<std::size_t>(width) *
                                 static_cast<std::size_t>(height));
  const auto cover = [&glyph](int x, int y) {
    const bool inside = x >= 0 && y >= 0 && x < glyph.width && y < glyph.height;
    return inside ? static_cast<float>(glyph.cover[static_cast<std::size_t>(y * glyph.width + x)])
                  : 0.0F;
  };
  const float reach = static_cast<float>(halo);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      float most = 0.0F;
      for (int dy = -halo; dy <= halo; ++dy) {
        for (int dx = -halo; dx <= halo; ++dx) {
          const float away = std::hypot(static_cast<float>(dx), static_cast<float>(dy));
          const float share = std::clamp(1.2F * (1.0F - away / (reach + 0.5F)), 0.0F, 1.0F);
          most = std::max(most, share * cover(x - halo + dx, y - halo + dy));
        }
      }
      const auto pixel = 2 * static_cast<std::size_t>(y * width + x);
      both[pixel] = static_cast<std::uint8_t>(cover(x - halo, y - halo));
      both[pixel + 1] = static_cast<std::uint8_t>(std::lround(most));
    }
  }
  return both;
}

}  // namespace

Result<LabelPass> LabelPass::create() {
  LabelPass pass;
  Result<GlProgram> program =
      make_program({{"frame.glsl", "label.vert.glsl"}, {"srgb.glsl", "label.frag.glsl"}});
  if (!program) return program.error();
  pass.program_ = std::move(*program);
  pass.atlas_ = make_target(GL_RG8, kAtlasSize, kAtlasSize);
  pass.layout_ = make_vertex_array();
  const GLuint layout = pass.layout_.get();
  constexpr std::array<std::size_t, 3> kPlaces{offsetof(Quad, place), offsetof(Quad, atlas),
                                               offsetof(Quad, color)};
  constexpr std::array<GLint, 3> kSizes{4, 2, 3};
  for (GLuint i = 0; i < kPlaces.size(); ++i) {
    glEnableVertexArrayAttrib(layout, i);
    glVertexArrayAttribFormat(layout, i, kSizes[i], GL_FLOAT, GL_FALSE,
                              static_cast<GLuint>(kPlaces[i]));
    glVertexArrayAttribBinding(layout, i, 0);
  }
  glVertexArrayBindingDivisor(layout, 0, 1);
  return pass;
}

void LabelPass::forget_glyphs() {
  glyphs_.clear();
  shelf_x_ = 0;
  shelf_y_ = 0;
  shelf_height_ = 0;
}

std::optional<LabelPass::StoredGlyph> LabelPass::stored(const Key& key) {
  if (const auto found = glyphs_.find(key); found != glyphs_.end()) return found->second;
  const float height_px = 0.25F * static_cast<float>(key.quarter_height);
  const GlyphBitmap bitmap = draw_glyph(key.glyph, height_px, 0.0F);
  StoredGlyph glyph;
  if (bitmap.width > 0) {
    const int halo = halo_px(height_px);
    glyph.width = bitmap.width + 2 * halo;
    glyph.height = bitmap.height + 2 * halo;
    glyph.left = bitmap.left - halo;
    glyph.top = bitmap.top - halo;
    if (shelf_x_ + glyph.width > kAtlasSize) {
      shelf_y_ += shelf_height_;
      shelf_x_ = 0;
      shelf_height_ = 0;
    }
    if (shelf_y_ + glyph.height > kAtlasSize || glyph.width > kAtlasSize) return std::nullopt;
    glyph.x = shelf_x_;
    glyph.y = shelf_y_;
    shelf_x_ += glyph.width;
    shelf_height_ = std::max(shelf_height_, glyph.height);
    const std::vector<std::uint8_t> pixels = with_halo(bitmap, halo);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(atlas_.get(), 0, glyph.x, glyph.y, glyph.width, glyph.height, GL_RG,
                        GL_UNSIGNED_BYTE, pixels.data());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  }
  glyphs_.emplace(key, glyph);
  return glyph;
}

bool LabelPass::lay_out(const Label& label, const FrameUniforms& frame) {
  Eigen::Vector4f at;
  at << label.at.cast<float>(), 1.0F;
  const Eigen::Vector4f clip = frame.projection * (frame.view * at);
  if (!(clip.w() > 1e-3F) || !clip.allFinite() || !(label.height_px >= 1.0F)) return true;
  const float height_px = std::min(label.height_px, kTallest);
  const int quarter_height = static_cast<int>(std::lround(4.0F * height_px));
  const float x = 0.5F * (clip.x() / clip.w() + 1.0F) * frame.size.x() + label.offset_px.x();
  const float y = 0.5F * (1.0F - clip.y() / clip.w()) * frame.size.y() + label.offset_px.y();
  // On whole pixels, so that the letters stay sharp; `y` is the middle of the line.
  const float start = std::round(x);
  const float baseline = std::round(y - 0.5F * height_px + ascent_px(height_px));
  const std::array<float, 3> color{label.color.x(), label.color.y(), label.color.z()};
  set_line(label.text, height_px, line_);
  for (const PlacedGlyph& placed : line_.glyphs) {
    const std::optional<StoredGlyph> glyph = stored({placed.glyph, quarter_height});
    if (!glyph) return false;
    if (glyph->width == 0) continue;
    const float left = start + std::round(placed.x) + static_cast<float>(glyph->left);
    const float top = baseline + static_cast<float>(glyph->top);
    laid_out_.push_back(
        {{left, top, static_cast<float>(glyph->width), static_cast<float>(glyph->height)},
         {static_cast<float>(glyph->x), static_cast<float>(glyph->y)},
         color});
  }
  return true;
}

bool LabelPass::lay_out(const std::vector<Label>& labels, const FrameUniforms& frame) {
  laid_out_.clear();
  for (const Label& label : labels) {
    if (!lay_out(label, frame)) return false;
  }
  return true;
}

void LabelPass::draw(const std::vector<Label>& labels, const FrameUniforms& frame) {
  if (labels.empty()) return;
  if (!lay_out(labels, frame)) {
    // Full of sizes that are no longer used: once more with those of this picture alone. What
    // even so has no room is left out.
    forget_glyphs();
    static_cast<void>(lay_out(labels, frame));
  }
  if (laid_out_.empty()) return;
  if (laid_out_.size() > room_) {
    room_ = 2 * laid_out_.size();
    quads_ =
        make_buffer(static_cast<GLsizeiptr>(room_ * sizeof(Quad)), nullptr, GL_DYNAMIC_STORAGE_BIT);
    glVertexArrayVertexBuffer(layout_.get(), 0, quads_.get(), 0, sizeof(Quad));
  }
  glNamedBufferSubData(quads_.get(), 0, static_cast<GLsizeiptr>(laid_out_.size() * sizeof(Quad)),
                       laid_out_.data());
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glUseProgram(program_.get());
  glBindTextureUnit(kAtlasUnit, atlas_.get());
  glBindVertexArray(layout_.get());
  const auto count = static_cast<GLsizei>(laid_out_.size());
  for (const GLint halo : {1, 0}) {
    glUniform1i(0, halo);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
  }
  glDisable(GL_BLEND);
}

}  // namespace nade::draw
