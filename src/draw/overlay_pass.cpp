#include "overlay_pass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace nade::draw {
namespace {

using Profile = std::vector<std::array<float, 5>>;  ///< radius, end, along, normal out and along

constexpr GLint kOpacityUniform = 0;
constexpr GLuint kFirstPartAttribute = 0;
constexpr GLuint kVertexAttribute = 4;
constexpr GLuint kPartBinding = 0;
constexpr GLuint kVertexBinding = 1;
constexpr float kBehindOpacity = 0.30F;
constexpr int kAround = 20;
/// An arrow's head, in radii of its shaft.
constexpr float kHeadLength = 7.0F;
constexpr float kHeadRadius = 2.6F;

std::array<float, 3> floats(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
std::array<float, 3> floats(const Color& c) { return {c.x(), c.y(), c.z()}; }

Profile arrow_profile() {
  const float slant = std::hypot(kHeadLength, kHeadRadius);
  const float out = kHeadLength / slant;
  const float along = kHeadRadius / slant;
  return {{0.0F, 0.0F, 0.0F, 0.0F, -1.0F},
          {1.0F, 0.0F, 0.0F, 0.0F, -1.0F},
          {1.0F, 0.0F, 0.0F, 1.0F, 0.0F},
          {1.0F, 1.0F, -kHeadLength, 1.0F, 0.0F},
          {1.0F, 1.0F, -kHeadLength, 0.0F, -1.0F},
          {kHeadRadius, 1.0F, -kHeadLength, 0.0F, -1.0F},
          {kHeadRadius, 1.0F, -kHeadLength, out, along},
          {0.0F, 1.0F, 0.0F, out, along}};
}

Profile ball_profile() {
  constexpr int kDown = 12;
  Profile profile;
  for (int i = 0; i <= kDown; ++i) {
    const float angle = std::numbers::pi_v<float> * static_cast<float>(i) / kDown;
    const float out = std::sin(angle);
    const float along = -std::cos(angle);
    profile.push_back({out, 0.0F, along, out, along});
  }
  return profile;
}

void use_parts(const GlVertexArray& layout, const GlBuffer& parts) {
  const GLuint name = layout.get();
  constexpr std::array<std::size_t, 4> kPlaces{
      offsetof(OverlayPart, from), offsetof(OverlayPart, to), offsetof(OverlayPart, color),
      offsetof(OverlayPart, size)};
  for (GLuint i = 0; i < kPlaces.size(); ++i) {
    const GLuint attribute = kFirstPartAttribute + i;
    glEnableVertexArrayAttrib(name, attribute);
    glVertexArrayAttribFormat(name, attribute, i == 3 ? 1 : 3, GL_FLOAT, GL_FALSE,
                              static_cast<GLuint>(kPlaces[i]));
    glVertexArrayAttribBinding(name, attribute, kPartBinding);
  }
  glVertexArrayBindingDivisor(name, kPartBinding, 1);
  glVertexArrayVertexBuffer(name, kPartBinding, parts.get(), 0, sizeof(OverlayPart));
}

}  // namespace

OverlayPass::Revolved OverlayPass::make_revolved(const Profile& profile) const {
  struct Vertex {
    std::array<float, 5> profile;
    std::array<float, 2> turn;
  };
  std::vector<Vertex> vertices;
  const auto at = [](const std::array<float, 5>& point, int step) {
    const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(step % kAround) /
                        static_cast<float>(kAround);
    return Vertex{point, {std::cos(angle), std::sin(angle)}};
  };
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    for (int step = 0; step < kAround; ++step) {
      const std::array<Vertex, 4> corners{at(profile[i], step), at(profile[i], step + 1),
                                          at(profile[i + 1], step), at(profile[i + 1], step + 1)};
      for (const std::size_t k : {0U, 1U, 2U, 2U, 1U, 3U}) vertices.push_back(corners[k]);
    }
  }
  Revolved revolved;
  revolved.count = static_cast<GLsizei>(vertices.size());
  revolved.vertices =
      make_buffer(static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(), 0);
  revolved.layout = make_vertex_array();
  const GLuint name = revolved.layout.get();
  constexpr std::array<GLint, 3> kSizes{3, 2, 2};
  GLuint place = 0;
  for (GLuint i = 0; i < kSizes.size(); ++i) {
    glEnableVertexArrayAttrib(name, kVertexAttribute + i);
    glVertexArrayAttribFormat(name, kVertexAttribute + i, kSizes[i], GL_FLOAT, GL_FALSE, place);
    glVertexArrayAttribBinding(name, kVertexAttribute + i, kVertexBinding);
    place += static_cast<GLuint>(kSizes[i]) * static_cast<GLuint>(sizeof(float));
  }
  glVertexArrayVertexBuffer(name, kVertexBinding, revolved.vertices.get(), 0, sizeof(Vertex));
  return revolved;
}

Result<OverlayPass> OverlayPass::create() {
  OverlayPass pass;
  Result<GlProgram> lines =
      make_program({{"frame.glsl", "line.vert.glsl"}, {"srgb.glsl", "line.frag.glsl"}});
  if (!lines) return lines.error();
  Result<GlProgram> solids = make_program(
      {{"frame.glsl", "revolved.vert.glsl"}, {"frame.glsl", "srgb.glsl", "revolved.frag.glsl"}});
  if (!solids) return solids.error();
  pass.line_program_ = std::move(*lines);
  pass.solid_program_ = std::move(*solids);
  pass.line_layout_ = make_vertex_array();
  pass.arrow_ = pass.make_revolved(arrow_profile());
  pass.dot_ = pass.make_revolved(ball_profile());
  return pass;
}

void OverlayPass::gather(const Scene& scene) {
  gathered_.clear();
  for (const Line& line : scene.lines) {
    gathered_.push_back({floats(line.from), floats(line.to), floats(line.color), line.width_px});
  }
  for (const Arrow& arrow : scene.arrows) {
    // A short arrow is a small one, not all head.
    const double length = (arrow.to - arrow.from).norm();
    const auto thickest = static_cast<float>(0.6 * length) / kHeadLength;
    gathered_.push_back({floats(arrow.from), floats(arrow.to), floats(arrow.color),
                         std::min(arrow.radius_m, thickest)});
  }
  for (const Dot& dot : scene.dots) {
    gathered_.push_back({floats(dot.center), floats(dot.center), floats(dot.color), dot.radius_m});
  }
  if (gathered_.size() > room_) {
    room_ = 2 * gathered_.size();
    parts_ = make_buffer(static_cast<GLsizeiptr>(room_ * sizeof(OverlayPart)), nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
    for (const auto* const layout : {&line_layout_, &arrow_.layout, &dot_.layout}) {
      use_parts(*layout, parts_);
    }
  }
  glNamedBufferSubData(parts_.get(), 0,
                       static_cast<GLsizeiptr>(gathered_.size() * sizeof(OverlayPart)),
                       gathered_.data());
}

void OverlayPass::draw_all(const Scene& scene) {
  const auto lines = static_cast<GLsizei>(scene.lines.size());
  const auto arrows = static_cast<GLsizei>(scene.arrows.size());
  const auto dots = static_cast<GLsizei>(scene.dots.size());
  glUseProgram(solid_program_.get());
  glBindVertexArray(arrow_.layout.get());
  glDrawArraysInstancedBaseInstance(GL_TRIANGLES, 0, arrow_.count, arrows,
                                    static_cast<GLuint>(lines));
  glBindVertexArray(dot_.layout.get());
  glDrawArraysInstancedBaseInstance(GL_TRIANGLES, 0, dot_.count, dots,
                                    static_cast<GLuint>(lines + arrows));
  glUseProgram(line_program_.get());
  glBindVertexArray(line_layout_.get());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, lines);
}

void OverlayPass::draw(const Scene& scene) {
  if (scene.lines.empty() && scene.arrows.empty() && scene.dots.empty()) return;
  gather(scene);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_GREATER);
  glProgramUniform1f(line_program_.get(), kOpacityUniform, kBehindOpacity);
  glProgramUniform1f(solid_program_.get(), kOpacityUniform, kBehindOpacity);
  draw_all(scene);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  glProgramUniform1f(line_program_.get(), kOpacityUniform, 1.0F);
  glProgramUniform1f(solid_program_.get(), kOpacityUniform, 1.0F);
  draw_all(scene);
  glDisable(GL_BLEND);
}

}  // namespace nade::draw
