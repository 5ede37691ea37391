#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "nade/hand_mesh.h"
#include "nade/surface.h"

namespace nade {

class NearObjects;
class Scene;

/// Flattens the skin of a hand of method `nade` where its flesh is sunk in an object, so that none
/// is below the surface, or on the other side of something thin. For what is drawn alone: contacts
/// and metrics are of the skin as it is posed. Keep one for each hand that is drawn.
class SkinFlattener {
 public:
  /// Measures the flesh of the mesh, as of SkinMap.
  explicit SkinFlattener(const HandMesh& mesh);
  SkinFlattener(const SkinFlattener&) = delete;
  SkinFlattener& operator=(const SkinFlattener&) = delete;
  SkinFlattener(SkinFlattener&& other) noexcept;
  SkinFlattener& operator=(SkinFlattener&& other) noexcept;
  ~SkinFlattener();

  /// `posed`: the skin as `pose_skin` gives it for `hand` and `scale`, world. `flattened` may be
  /// the same, and differs where skin is nearer to the surface than 2 mm, or sunk: there it lies
  /// 0.2 mm above, on the side that the flesh came in from. `normals`, posed likewise, turn along;
  /// they may be empty. All hold as many as the mesh has vertices.
  ///
  /// Skin that is sunk deeper than its flesh gives way, by 2 mm, is moved less, by 6 mm not at
  /// all: a hand that is inside stays so. `give_m`: the surface gives way by so much, as of a soft
  /// object; skin is flattened so much below it. A pose that cannot be used leaves the skin as it
  /// is. Never allocates.
  void flatten(const Object& object, const HandPose& hand, double scale, double give_m,
               std::span<const Eigen::Vector3f> posed, std::span<Eigen::Vector3f> flattened,
               std::span<Eigen::Vector3f> normals) noexcept;
  /// The same on all objects of a scene that are within reach.
  void flatten(const Scene& scene, const HandPose& hand, double scale, double give_m,
               std::span<const Eigen::Vector3f> posed, std::span<Eigen::Vector3f> flattened,
               std::span<Eigen::Vector3f> normals) noexcept;

 private:
  /// Some skin that one bone leads. Out of the surface is where its flesh is: a closest point
  /// would take what lies beyond the middle of a board for the other side's.
  struct Piece {
    std::size_t bone = 0;  ///< as index_of(Joint)
    Vec3 skin_local = Vec3::Zero();
    Vec3 inward_local = Vec3::Zero();  ///< unit
    double flesh_m = 0.0;              ///< the deepest of it
    double radius_m = 0.0;             ///< no vertex of it is farther from `skin_local`
    std::vector<std::size_t> vertices;
    SurfaceHint hint;
    Vec3 inner = Vec3::Zero();  ///< in this frame: a point in its flesh,
    double height_m = 0.0;      ///< how high that is, at the least
    Vec3 out = Vec3::Zero();    ///< and the way out of the surface, as long as it counts
  };
  /// A vertex goes by the pieces about it.
  struct Share {
    std::uint32_t piece = 0;
    double weight = 0.0;
  };

  void cut(const HandMesh& mesh);
  void share(const HandMesh& mesh);
  void meet(const Object& object) noexcept;
  void find_ways_out(const Object& object, const HandPose& hand, double scale,
                     double give_m) noexcept;
  [[nodiscard]] Vec3 way_out(std::size_t vertex) const noexcept;

  std::vector<double> flesh_m_;  ///< by vertex
  std::vector<Piece> pieces_;
  std::vector<Share> shares_;
  std::vector<std::uint32_t> first_share_;  ///< by vertex, and the end of the last
  ObjectIdentity met_;                      ///< what the hints are of
  std::unique_ptr<NearObjects> near_;
};

}  // namespace nade
