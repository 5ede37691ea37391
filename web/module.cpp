#include <cstddef>

#include "nade.h"

// web/src/layout.ts reads and writes these structs by these offsets.
static_assert(sizeof(nade_joint) == 32 && offsetof(nade_joint, position) == 16 &&
              offsetof(nade_joint, radius) == 28);
static_assert(sizeof(nade_placement) == 32 && offsetof(nade_placement, scale) == 28);
static_assert(sizeof(nade_feel) == 48 && offsetof(nade_feel, softness_m) == 8);
static_assert(sizeof(nade_corrector_options) == 40 &&
              offsetof(nade_corrector_options, method) == 4 &&
              offsetof(nade_corrector_options, release_s) == 8 &&
              offsetof(nade_corrector_options, hand_length_m) == 16 &&
              offsetof(nade_corrector_options, feel) == 24 &&
              offsetof(nade_corrector_options, left_flesh) == 28 &&
              offsetof(nade_corrector_options, right_flesh) == 32);
static_assert(sizeof(nade_contact) == 56 && offsetof(nade_contact, bone) == 8 &&
              offsetof(nade_contact, depth_m) == 12 && offsetof(nade_contact, point) == 16 &&
              offsetof(nade_contact, normal) == 28 && offsetof(nade_contact, velocity_mps) == 40);
static_assert(sizeof(nade_result) == 2056 && offsetof(nade_result, joints) == 16 &&
              offsetof(nade_result, velocity_mps) == 848 &&
              offsetof(nade_result, contacts) == 1160);
static_assert(sizeof(nade_mesh) == 32 && offsetof(nade_mesh, scale) == 12 &&
              offsetof(nade_mesh, vertices) == 24 && offsetof(nade_mesh, triangles) == 28);
static_assert(sizeof(nade_mesh_report) == 32);
static_assert(sizeof(nade_surface_point) == 56 && offsetof(nade_surface_point, normal) == 24 &&
              offsetof(nade_surface_point, signed_distance) == 48);
static_assert(sizeof(nade_group_member) == 36 && offsetof(nade_group_member, placement) == 4);
static_assert(sizeof(nade_hand_mesh) == 40 && offsetof(nade_hand_mesh, vertices) == 16);
