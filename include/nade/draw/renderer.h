#pragma once

#include <memory>
#include <span>
#include <vector>

#include "nade/draw/scene.h"
#include "nade/status.h"

namespace nade::draw {

/// Where a picture goes: a framebuffer of the current context (0: the window). What is written is
/// sRGB-encoded; the framebuffer must not encode it again.
struct Target {
  unsigned framebuffer = 0;
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// An eye, and where what it sees goes.
struct Sight {
  Camera camera;
  Target target;
};

/// Which side of the triangles a depth map is of.
enum class Faces : std::uint8_t { front, back };

/// Distance from the eye's plane, metres; infinity where nothing is. Top row first.
struct DepthMap {
  int width = 0;
  int height = 0;
  std::vector<float> depth_m;
};

/// Draws scenes in the OpenGL context that is current when it is made and when it is used. The
/// same scene gives the same picture, to the bit on the same driver.
class Renderer {
 public:
  /// Compiles what it needs. The error says what the context lacks.
  [[nodiscard]] static Result<Renderer> create();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  /// Takes a mesh to the graphics card; missing normals are computed.
  [[nodiscard]] MeshId add(const DrawnMesh& mesh);
  void remove(MeshId mesh);

  /// New shape of a mesh that moves: as many as it was added with. Does not allocate.
  void set_shape(MeshId mesh, std::span<const Eigen::Vector3f> positions,
                 std::span<const Eigen::Vector3f> normals);
  /// New colours at the vertices; empty takes them away.
  void set_colors(MeshId mesh, std::span<const Color> colors);
  void set_material(MeshId mesh, const Material& material);
  /// Another picture on a mesh that was added with one of the same size.
  void set_texture(MeshId mesh, const Image& image);

  /// Draws into a framebuffer, 4 samples a pixel.
  void draw(const Scene& scene, const Camera& camera, const Target& target);
  /// The same for several eyes at once, such as a headset's two: what does not depend on the eye is
  /// drawn once.
  void draw(const Scene& scene, std::span<const Sight> sights);
  /// Draws into a picture.
  [[nodiscard]] Image picture(const Scene& scene, const Camera& camera, int width, int height);
  /// Depths of the scene's instances, without floor and diagram parts, one sample a pixel.
  [[nodiscard]] DepthMap depths(const Scene& scene, const Camera& camera, int width, int height,
                                Faces faces);

 private:
  struct Impl;
  explicit Renderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace nade::draw
