#include "gl_objects.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "embedded.h"
#include "nade/assert.h"

namespace nade::draw {
namespace {

class Shader {
 public:
  explicit Shader(GLenum stage) : name_(glCreateShader(stage)) {}
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  ~Shader() { glDeleteShader(name_); }
  [[nodiscard]] GLuint get() const { return name_; }

 private:
  GLuint name_;
};

std::string log_of_shader(GLuint shader) {
  GLint length = 0;
  glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length), '\0');
  glGetShaderInfoLog(shader, length, &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  return log;
}

std::string log_of_program(GLuint program) {
  GLint length = 0;
  glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length), '\0');
  glGetProgramInfoLog(program, length, &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  return log;
}

std::string_view last_of(std::initializer_list<std::string_view> files) {
  return files.begin()[files.size() - 1];
}

Status compile(const Shader& shader, std::initializer_list<std::string_view> files,
               std::string_view definitions) {
  std::string text = fmt::format("#version 450 core\n{}", definitions);
  int number = 0;
  for (const std::string_view file : files) {
    const std::string_view source = embedded_file(file);
    NADE_ASSERT(!source.empty());
    text += fmt::format("#line 1 {}\n{}\n", ++number, source);
  }
  const char* const start = text.c_str();
  glShaderSource(shader.get(), 1, &start, nullptr);
  glCompileShader(shader.get());
  GLint done = GL_FALSE;
  glGetShaderiv(shader.get(), GL_COMPILE_STATUS, &done);
  if (done == GL_TRUE) return ok_status();
  return Error{ErrorCode::bad_format, fmt::format("{}: the OpenGL driver cannot compile it: {}",
                                                  last_of(files), log_of_shader(shader.get()))};
}

}  // namespace

GlBuffer make_buffer() {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  return GlBuffer(name);
}

GlBuffer make_buffer(GLsizeiptr size, const void* data, GLbitfield flags) {
  GlBuffer buffer = make_buffer();
  glNamedBufferStorage(buffer.get(), size, data, flags);
  return buffer;
}

GlTexture make_texture(GLenum target) {
  GLuint name = 0;
  glCreateTextures(target, 1, &name);
  return GlTexture(name);
}

GlTexture make_target(GLenum format, int width, int height) {
  GlTexture texture = make_texture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.get(), 1, format, width, height);
  glTextureParameteri(texture.get(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.get(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTextureParameteri(texture.get(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture.get(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

GlFramebuffer make_framebuffer() {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  return GlFramebuffer(name);
}

GlRenderbuffer make_renderbuffer(GLenum format, int samples, int width, int height) {
  GLuint name = 0;
  glCreateRenderbuffers(1, &name);
  glNamedRenderbufferStorageMultisample(name, samples, format, width, height);
  return GlRenderbuffer(name);
}

GlVertexArray make_vertex_array() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return GlVertexArray(name);
}

Result<GlProgram> make_program(const ProgramFiles& files) {
  const Shader vertex(GL_VERTEX_SHADER);
  const Shader fragment(GL_FRAGMENT_SHADER);
  if (Status compiled = compile(vertex, files.vertex, {}); !compiled) return compiled.error();
  if (Status compiled = compile(fragment, files.fragment, files.definitions); !compiled)
    return compiled.error();
  GlProgram program(glCreateProgram());
  glAttachShader(program.get(), vertex.get());
  glAttachShader(program.get(), fragment.get());
  glLinkProgram(program.get());
  glDetachShader(program.get(), vertex.get());
  glDetachShader(program.get(), fragment.get());
  GLint done = GL_FALSE;
  glGetProgramiv(program.get(), GL_LINK_STATUS, &done);
  if (done == GL_TRUE) return program;
  return Error{
      ErrorCode::bad_format,
      fmt::format("{} and {}: the OpenGL driver cannot link them: {}", last_of(files.vertex),
                  last_of(files.fragment), log_of_program(program.get()))};
}

Status make_program(const ProgramFiles& files, GlProgram& into) {
  Result<GlProgram> program = make_program(files);
  if (!program) return program.error();
  into = std::move(*program);
  return ok_status();
}

}  // namespace nade::draw
