#pragma once

// The tree's queries. Included by one source file for each instruction set, after
// NADE_TREE_KERNELS names the function that file defines. Nothing here may call an inline
// function of another header: its copy for the wrong instruction set could end up being the one
// the linker keeps.

// Based on: Baldwin, Weber. Fast Ray-Triangle Intersections by Coordinate Transformation. 2016;
// Davidovic et al. 3D Rasterization: A Bridge between Rasterization and Ray Casting. 2012 (edge
// volumes that are exactly opposite on either side of an edge, so that no ray slips through).
// Based on: Barill, Dickson, Schmidt, Levin, Jacobson. Fast Winding Numbers for Soups and
// Clouds. 2018.
// Based on: Van Oosterom, Strackee. The Solid Angle of a Plane Triangle. 1983.

#include "simd8.h"
#include "triangle_tree_layout.h"

namespace nade::detail {
namespace {  // NOLINT(cert-dcl59-cpp): as in simd8.h

constexpr std::uint32_t kStackSize = kTreeDepth * (kTreeWidth - 1) + kTreeWidth;
constexpr float kInfinity = __builtin_huge_valf();

struct StackEntry {
  float key;  ///< nothing below this child is nearer
  std::uint32_t child;
};

/// Children still to be visited, nearest on top.
struct Stack {
  StackEntry entries[kStackSize];
  StackEntry* top = entries;  ///< one beyond the last

  /// Where to go next among the children in `lanes` (one at least); the others wait.
  std::uint32_t descend(const TreeNode& node, Float8 keys8, unsigned lanes) {
    const int first = __builtin_ctz(lanes);
    lanes &= lanes - 1;
    if (lanes == 0) return node.child[first];
    float keys[kTreeWidth];
    store8(keys, keys8);
    StackEntry nearest{keys[first], node.child[first]};
    const int second = __builtin_ctz(lanes);
    lanes &= lanes - 1;
    if (lanes == 0) {
      StackEntry other{keys[second], node.child[second]};
      const bool swap = other.key < nearest.key;
      *top++ = swap ? nearest : other;
      return swap ? other.child : nearest.child;
    }
    lanes |= 1U << second;
    StackEntry* const bottom = top;
    do {
      const int lane = __builtin_ctz(lanes);
      lanes &= lanes - 1;
      StackEntry entry{keys[lane], node.child[lane]};
      if (entry.key < nearest.key) {
        const StackEntry other = nearest;
        nearest = entry;
        entry = other;
      }
      StackEntry* place = top++;
      for (; place != bottom && place[-1].key < entry.key; --place) *place = place[-1];
      *place = entry;
    } while (lanes != 0);
    return nearest.child;
  }

  /// The next child nearer than `bound`; or `kNoChild`.
  std::uint32_t pop(float bound) {
    while (top != entries) {
      --top;
      if (top->key < bound) return top->child;
    }
    return kNoChild;
  }
};

/// The ray, spread over the lanes and made ready for boxes.
struct Ray8 {
  Vec8 origin;
  Vec8 direction;
  Vec8 inverse;
  Vec8 scaled_origin;  ///< times `inverse`
  int near_side[3];    ///< as a place in `TreeNode::side`

  explicit Ray8(const TreeRay& ray)
      : origin(all_vec8(ray.origin)), direction(all_vec8(ray.direction)) {
    float inverse_direction[3];
    for (int axis = 0; axis < 3; ++axis) {
      const float d = ray.direction[axis];
      constexpr float kSmallest = 1e-18F;
      const float magnitude = __builtin_fabsf(d) < kSmallest ? kSmallest : __builtin_fabsf(d);
      inverse_direction[axis] = 1.0F / __builtin_copysignf(magnitude, d);
      near_side[axis] = inverse_direction[axis] < 0.0F ? axis + 3 : axis;
    }
    inverse = all_vec8(inverse_direction);
    scaled_origin = {origin.x * inverse.x, origin.y * inverse.y, origin.z * inverse.z};
  }
};

struct BoxHits {
  Float8 entry;
  unsigned lanes;
};

inline BoxHits enter_boxes(const TreeNode& node, const Ray8& ray, float bound) {
  const auto slab = [&](int side, Float8 origin, Float8 inverse) {
    return fms8(load8(node.side[side]), inverse, origin);
  };
  const int* const near_side = ray.near_side;
  const Float8 near_x = slab(near_side[0], ray.scaled_origin.x, ray.inverse.x);
  const Float8 near_y = slab(near_side[1], ray.scaled_origin.y, ray.inverse.y);
  const Float8 near_z = slab(near_side[2], ray.scaled_origin.z, ray.inverse.z);
  const Float8 far_x = slab(3 - near_side[0], ray.scaled_origin.x, ray.inverse.x);
  const Float8 far_y = slab(5 - near_side[1], ray.scaled_origin.y, ray.inverse.y);
  const Float8 far_z = slab(7 - near_side[2], ray.scaled_origin.z, ray.inverse.z);
  const Float8 entry = max8(max8(near_x, near_y), max8(near_z, all8(0.0F)));
  const Float8 exit = min8(min8(far_x, far_y), min8(far_z, all8(bound)));
  return {entry, bits8(less_equal8(entry, exit))};
}

/// The first lane that holds a value or less, which one of them does. With the lowest of them that
/// costs no branch for each lane; which is lower than those before it is a coin toss.
inline std::uint32_t lane_of(float value, Float8 values) {
  const unsigned lanes = bits8(less_equal8(values, all8(value)));
  return static_cast<std::uint32_t>(__builtin_ctz(lanes));
}

inline void hit_block(const TriangleBlock* blocks, std::uint32_t index, const Ray8& ray,
                      TreeHit& best) {
  const TriangleBlock& block = blocks[index];
  const Vec8 a = load_vec8(block.a) - ray.origin;
  const Vec8 b = load_vec8(block.b) - ray.origin;
  const Vec8 c = load_vec8(block.c) - ray.origin;
  const Vec8 ab = b - a;
  const Vec8 bc = c - b;
  const Vec8 ca = a - c;
  // Six times the volume between the ray and each edge: on which side the ray passes it.
  const Float8 w_c = dot8(cross8(ab, a + b), ray.direction);
  const Float8 w_a = dot8(cross8(bc, b + c), ray.direction);
  const Float8 w_b = dot8(cross8(ca, c + a), ray.direction);
  const Float8 zero = all8(0.0F);
  const Float8 lowest = min8(w_a, min8(w_b, w_c));
  const Float8 highest = max8(w_a, max8(w_b, w_c));
  const Float8 inside = or8(less_equal8(zero, lowest), less_equal8(highest, zero));
  if (bits8(inside) == 0) return;  // before the division
  const Vec8 normal = cross8(ab, ca);
  const Float8 distance = dot8(a, normal) / dot8(normal, ray.direction);
  const Float8 hits =
      and8(inside, and8(less_equal8(zero, distance), less8(distance, all8(best.distance))));
  if (bits8(hits) == 0) return;
  const Float8 distances = select8(hits, distance, all8(kInfinity));
  const float nearest = lowest8(distances);
  best.slot = index * kTreeWidth + lane_of(nearest, distances);
  best.distance = nearest;
}

TreeHit first_hit_kernel(const TreeNode* nodes, const TriangleBlock* blocks,
                         const TreeRay& query) noexcept {
  const Ray8 ray(query);
  TreeHit best{kNoSlot, query.max_distance, 0};
  Stack stack;
  std::uint32_t current = 0;
  std::uint32_t steps = 0;
  while (current != kNoChild && steps < kMostSteps) {
    ++steps;
    if ((current & kLeafBit) != 0) {
      hit_block(blocks, current & ~kLeafBit, ray, best);
    } else {
      const TreeNode& node = nodes[current];
      const BoxHits hits = enter_boxes(node, ray, best.distance);
      if (hits.lanes != 0) {
        current = stack.descend(node, hits.entry, hits.lanes);
        continue;
      }
    }
    current = stack.pop(best.distance);
  }
  best.steps = steps;
  return best;
}

/// Squared distance from `p`, given from one end, to a segment.
inline Float8 segment_squared(const Vec8& p, const Vec8& along) {
  const Float8 share = min8(max8(dot8(p, along) / dot8(along, along), all8(0.0F)), all8(1.0F));
  const Vec8 d{p.x - share * along.x, p.y - share * along.y, p.z - share * along.z};
  return dot8(d, d);
}

struct BestYet {
  float squared;
  std::uint32_t slot;
};

inline void nearest_in_block(const TriangleBlock* blocks, std::uint32_t index, const Vec8& point,
                             BestYet& best) {
  const TriangleBlock& block = blocks[index];
  const Vec8 a = load_vec8(block.a);
  const Vec8 b = load_vec8(block.b);
  const Vec8 c = load_vec8(block.c);
  const Vec8 ab = b - a;
  const Vec8 bc = c - b;
  const Vec8 ca = a - c;
  const Vec8 pa = point - a;
  const Vec8 pb = point - b;
  const Vec8 pc = point - c;
  const Vec8 normal = cross8(ca, ab);
  const Float8 within_ab = dot8(cross8(normal, ab), pa);
  const Float8 within_bc = dot8(cross8(normal, bc), pb);
  const Float8 within_ca = dot8(cross8(normal, ca), pc);
  const Float8 above = less8(all8(0.0F), min8(within_ab, min8(within_bc, within_ca)));
  const Float8 height = dot8(normal, pa);
  const Float8 to_plane = height * height / dot8(normal, normal);
  const Float8 to_edges =
      min8(segment_squared(pa, ab), min8(segment_squared(pb, bc), segment_squared(pc, ca)));
  const Float8 squared = select8(above, to_plane, to_edges);
  const float lowest = lowest8(squared);
  if (lowest < best.squared) best = {lowest, index * kTreeWidth + lane_of(lowest, squared)};
}

inline Float8 box_squared(const TreeNode& node, const Vec8& point) {
  const Float8 zero = all8(0.0F);
  const Float8 x = max8(max8(load8(node.side[0]) - point.x, point.x - load8(node.side[3])), zero);
  const Float8 y = max8(max8(load8(node.side[1]) - point.y, point.y - load8(node.side[4])), zero);
  const Float8 z = max8(max8(load8(node.side[2]) - point.z, point.z - load8(node.side[5])), zero);
  return fma8(x, x, fma8(y, y, z * z));
}

TreeNearest closest_kernel(const TreeNode* nodes, const TriangleBlock* blocks,
                           const TreePoint& query) noexcept {
  const Vec8 point = all_vec8(query.point);
  BestYet best{query.bound_squared, kNoSlot};
  if (query.hint_block != kNoSlot) nearest_in_block(blocks, query.hint_block, point, best);
  Stack stack;
  std::uint32_t current = 0;
  std::uint32_t steps = 0;
  while (current != kNoChild && steps < kMostSteps) {
    ++steps;
    if ((current & kLeafBit) != 0) {
      const std::uint32_t block = current & ~kLeafBit;
      if (block != query.hint_block) nearest_in_block(blocks, block, point, best);
    } else {
      const TreeNode& node = nodes[current];
      const Float8 squared = box_squared(node, point);
      const unsigned lanes = bits8(less8(squared, all8(best.squared)));
      if (lanes != 0) {
        current = stack.descend(node, squared, lanes);
        continue;
      }
    }
    current = stack.pop(best.squared);
  }
  return {best.slot, steps};
}

/// atan2 to 1e-4; 0 at the origin.
inline Float8 atan2_8(Float8 y, Float8 x) {
  const Float8 zero = all8(0.0F);
  const Float8 ax = abs8(x);
  const Float8 ay = abs8(y);
  const Float8 larger = max8(max8(ax, ay), all8(1e-30F));
  const Float8 t = min8(ax, ay) / larger;
  const Float8 t2 = t * t;
  // Odd minimax polynomial on [0, 1].
  Float8 angle = fma8(t2, all8(0.0208351F), all8(-0.0851330F));
  angle = fma8(t2, angle, all8(0.1801410F));
  angle = fma8(t2, angle, all8(-0.3302995F));
  angle = fma8(t2, angle, all8(0.9998660F)) * t;
  angle = select8(less8(ax, ay), all8(1.57079633F) - angle, angle);
  angle = select8(less8(x, zero), all8(3.14159265F) - angle, angle);
  return select8(less8(y, zero), zero - angle, angle);
}

inline float sum8(Float8 a) {
  float v[kTreeWidth];
  store8(v, a);
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

/// Half the solid angles of the block's triangles, summed.
inline float half_solid_angle(const TriangleBlock& block, const Vec8& point) {
  const Vec8 a = load_vec8(block.a) - point;
  const Vec8 b = load_vec8(block.b) - point;
  const Vec8 c = load_vec8(block.c) - point;
  const Float8 la = sqrt8(dot8(a, a));
  const Float8 lb = sqrt8(dot8(b, b));
  const Float8 lc = sqrt8(dot8(c, c));
  const Float8 volume = dot8(a, cross8(b, c));
  const Float8 flat = la * lb * lc + dot8(a, b) * lc + dot8(b, c) * la + dot8(c, a) * lb;
  return sum8(atan2_8(volume, flat));
}

TreeWinding winding_kernel(const TreeNode* nodes, const TriangleBlock* blocks,
                           const DipoleNode* dipoles, const float (&query)[3]) noexcept {
  const Vec8 point = all_vec8(query);
  Float8 far_sum = all8(0.0F);
  float near_sum = 0.0F;
  // Level by level: where there is no more room, what is left to look into is small everywhere.
  std::uint32_t queue[kMostWindingSteps];
  std::uint32_t queued = 0;
  queue[queued++] = 0;
  std::uint32_t steps = 0;
  while (steps < queued) {
    const std::uint32_t current = queue[steps++];
    if ((current & kLeafBit) != 0) {
      near_sum += half_solid_angle(blocks[current & ~kLeafBit], point);
      continue;
    }
    const DipoleNode& dipole = dipoles[current];
    const Vec8 to = load_vec8(dipole.centre) - point;
    Float8 squared = dot8(to, to);
    const Float8 near_squared = load8(dipole.near_squared);
    Float8 is_far = less8(near_squared, squared);
    if (queued + kTreeWidth > kMostWindingSteps) {
      // All as dipoles, and the point no farther within one than at its radius.
      squared = max8(squared, near_squared * all8(1.0F / (kDipoleFar * kDipoleFar)));
      is_far = less_equal8(squared, squared);
    }
    const Float8 share = dot8(load_vec8(dipole.vector_area), to) / (squared * sqrt8(squared));
    far_sum = far_sum + select8(is_far, share, all8(0.0F));
    for (unsigned lanes = ~bits8(is_far) & 0xffU; lanes != 0; lanes &= lanes - 1) {
      queue[queued++] = nodes[current].child[__builtin_ctz(lanes)];
    }
  }
  constexpr float kPi = 3.14159265F;
  return {near_sum / (2.0F * kPi) + sum8(far_sum) / (4.0F * kPi), steps};
}

constexpr TreeKernels kKernels{first_hit_kernel, closest_kernel, winding_kernel};

}  // namespace

const TreeKernels& NADE_TREE_KERNELS() noexcept { return kKernels; }

}  // namespace nade::detail
