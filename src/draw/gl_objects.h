#pragma once

#include <epoxy/gl.h>

#include <initializer_list>
#include <string_view>
#include <utility>

#include "nade/status.h"

namespace nade::draw {

/// Owns an OpenGL object by its name; 0 owns nothing. Freed in the context that is current then.
template <void (*kFree)(GLuint)>
class GlName {
 public:
  GlName() = default;
  explicit GlName(GLuint name) : name_(name) {}
  GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~GlName() {
    if (name_ != 0) kFree(name_);
  }
  [[nodiscard]] GLuint get() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  GLuint name_ = 0;
};

namespace detail {
inline void free_buffer(GLuint name) { glDeleteBuffers(1, &name); }
inline void free_texture(GLuint name) { glDeleteTextures(1, &name); }
inline void free_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }
inline void free_renderbuffer(GLuint name) { glDeleteRenderbuffers(1, &name); }
inline void free_vertex_array(GLuint name) { glDeleteVertexArrays(1, &name); }
inline void free_program(GLuint name) { glDeleteProgram(name); }
}  // namespace detail

using GlBuffer = GlName<&detail::free_buffer>;
using GlTexture = GlName<&detail::free_texture>;
using GlFramebuffer = GlName<&detail::free_framebuffer>;
using GlRenderbuffer = GlName<&detail::free_renderbuffer>;
using GlVertexArray = GlName<&detail::free_vertex_array>;
using GlProgram = GlName<&detail::free_program>;

[[nodiscard]] GlBuffer make_buffer();
[[nodiscard]] GlBuffer make_buffer(GLsizeiptr size, const void* data, GLbitfield flags);
[[nodiscard]] GlTexture make_texture(GLenum target);
/// Two-dimensional, without mipmaps: nearest, clamped to its edge.
[[nodiscard]] GlTexture make_target(GLenum format, int width, int height);
[[nodiscard]] GlFramebuffer make_framebuffer();
[[nodiscard]] GlRenderbuffer make_renderbuffer(GLenum format, int samples, int width, int height);
[[nodiscard]] GlVertexArray make_vertex_array();

/// The embedded shader files that make up one program, in the order they are put together.
struct ProgramFiles {
  std::initializer_list<std::string_view> vertex;
  std::initializer_list<std::string_view> fragment;
  std::string_view definitions{};  ///< lines that stand before the fragment files
};
/// The error names the file and what the driver said of it.
[[nodiscard]] Result<GlProgram> make_program(const ProgramFiles& files);
/// The same into a program that is there; as it was where that fails.
[[nodiscard]] Status make_program(const ProgramFiles& files, GlProgram& into);

}  // namespace nade::draw
