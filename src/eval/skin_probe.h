#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "nade/hand_mesh.h"
#include "nade/surface.h"
#include "wall_memory.h"

namespace nade {

inline constexpr double kNotMeasured = std::numeric_limits<double>::infinity();

/// How a posed skin lies to an object, metres.
struct SkinReading {
  /// Signed distance of the deepest vertex; of a hand that touches nowhere, a lower bound.
  double lowest = kNotMeasured;
  bool touches = false;  ///< some vertex lies within `kTouch_m` of the surface, from either side
  /// Signed distance of each part's deepest patch vertex; infinite where it was not looked at.
  std::array<double, kPartCount> patch_lowest{kNotMeasured, kNotMeasured, kNotMeasured,
                                              kNotMeasured, kNotMeasured, kNotMeasured};
};

/// What counts as pressing, and as touching, metres.
inline constexpr double kPressing_m = 0.002;
inline constexpr double kTouch_m = 0.002;

/// Measures the posed skin of one hand against an object.
///
/// A part's patch: `is_in_patch`.
///
/// Most vertices need no query: a signed distance changes no faster than the point moves, so one
/// query at the middle of a cluster of vertices bounds them all. Where a surface's distance is
/// not of that kind (a sheet's sign changes beyond its border) that may miss a vertex there.
class SkinProbe {
 public:
  SkinProbe(const HandMesh& mesh, double scale);

  /// Call it for every frame: in and beyond a thin wall depth counts from the side that was
  /// entered.
  [[nodiscard]] SkinReading read(const HandPose& hand, const Object& object);
  /// The next hand does not go on from the last one.
  void break_off() { walls_.forget(); }

  /// The signed distance of each vertex of the mesh, metres; infinite for skin that certainly lies
  /// no lower than `limit_m`. Of the hand that was read last.
  [[nodiscard]] std::span<const double> read_below(const HandPose& hand, const Object& object,
                                                   double limit_m);
  /// The same of one vertex of the hand that was read last, however far it is; in what `read_below`
  /// gave, too.
  void complete(std::size_t vertex, const Object& object);

 private:
  struct Vertex {
    std::uint32_t index;   ///< in the mesh
    std::uint8_t patches;  ///< bit i: belongs to part i
    std::uint8_t bone;     ///< that weighs most on it
  };
  struct Cluster {
    std::size_t first = 0;  ///< in vertices_: its middle
    std::size_t count = 0;
  };
  struct MiddleReading {
    const Cluster* cluster;
    double distance_m;  ///< signed
  };

  /// No skin of the hand lies lower; infinite where there is no object.
  [[nodiscard]] double least_distance(const HandPose& hand, const Object& object);
  void make_clusters(const std::vector<std::uint8_t>& patches);
  void take(std::size_t slot, double distance, SkinReading& reading) const;
  [[nodiscard]] double measure(std::size_t slot, const Object& object, SkinReading& reading);
  void read_cluster(const MiddleReading& middle, const Object& object, SkinReading& reading);
  void follow_walls(const MiddleReading& middle, const HandPose& hand, const Object& object,
                    SkinReading& reading);
  [[nodiscard]] Vec3 position(std::size_t slot) const;

  const HandMesh* mesh_;
  double scale_;
  std::vector<Vertex> vertices_;
  std::vector<Cluster> clusters_;
  std::vector<SurfaceHint> hints_;    ///< for each of vertices_
  std::vector<std::size_t> slot_of_;  ///< by vertex of the mesh
  std::vector<double> distances_m_;   ///< by vertex of the mesh
  std::vector<double> through_m_;     ///< the same, where it is in a thin wall; else infinite
  std::vector<Eigen::Vector3f> skin_;
  std::vector<MiddleReading> middles_;
  WallMemory walls_;
  SurfaceHint palm_hint_;
};

}  // namespace nade
