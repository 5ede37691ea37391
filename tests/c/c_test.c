/* nade.h as a program in C sees it: layouts, wrong arguments, a stroke. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "nade.h"

static int failures = 0;

static void check(int condition, const char* what, int line) {
  if (condition) return;
  printf("c_test.c:%d: %s\n", line, what);
  ++failures;
}
#define CHECK(condition) check(condition, #condition, __LINE__)
#define CHECK_OK(call) CHECK((call) == NADE_OK)
#define CHECK_LAYOUT(type, field, offset, bytes) \
  CHECK(offsetof(type, field) == (offset) && sizeof(((type*)0)->field) == (bytes))

static void check_layouts(void) {
  CHECK(sizeof(nade_joint) == 32);
  CHECK_LAYOUT(nade_joint, rotation, 0, 16);
  CHECK_LAYOUT(nade_joint, position, 16, 12);
  CHECK_LAYOUT(nade_joint, radius, 28, 4);
  CHECK(sizeof(nade_placement) == 32);
  CHECK_LAYOUT(nade_placement, rotation, 0, 16);
  CHECK_LAYOUT(nade_placement, position, 16, 12);
  CHECK_LAYOUT(nade_placement, scale, 28, 4);
  CHECK(sizeof(nade_feel) == 48);
  CHECK_LAYOUT(nade_feel, size, 0, 4);
  CHECK_LAYOUT(nade_feel, reserved, 4, 4);
  CHECK_LAYOUT(nade_feel, softness_m, 8, 8);
  CHECK_LAYOUT(nade_feel, softness_depth_m, 16, 8);
  CHECK_LAYOUT(nade_feel, friction, 24, 8);
  CHECK_LAYOUT(nade_feel, friction_kinetic, 32, 8);
  CHECK_LAYOUT(nade_feel, longest_lag_m, 40, 8);
  CHECK(sizeof(nade_contact) == 56);
  CHECK_LAYOUT(nade_contact, object, 0, 8);
  CHECK_LAYOUT(nade_contact, bone, 8, 4);
  CHECK_LAYOUT(nade_contact, depth_m, 12, 4);
  CHECK_LAYOUT(nade_contact, point, 16, 12);
  CHECK_LAYOUT(nade_contact, normal, 28, 12);
  CHECK_LAYOUT(nade_contact, velocity_mps, 40, 12);
  CHECK_LAYOUT(nade_contact, reserved, 52, 4);
  CHECK(sizeof(nade_result) == 2056);
  CHECK_LAYOUT(nade_result, size, 0, 4);
  CHECK_LAYOUT(nade_result, status, 4, 4);
  CHECK_LAYOUT(nade_result, fault, 8, 4);
  CHECK_LAYOUT(nade_result, contact_count, 12, 4);
  CHECK_LAYOUT(nade_result, joints, 16, 832);
  CHECK_LAYOUT(nade_result, velocity_mps, 848, 312);
  CHECK_LAYOUT(nade_result, contacts, 1160, 896);
  CHECK(sizeof(nade_mesh_report) == 32);
  CHECK_LAYOUT(nade_mesh_report, size, 0, 4);
  CHECK_LAYOUT(nade_mesh_report, solid, 4, 4);
  CHECK_LAYOUT(nade_mesh_report, triangles_used, 8, 4);
  CHECK_LAYOUT(nade_mesh_report, triangles_degenerate, 12, 4);
  CHECK_LAYOUT(nade_mesh_report, triangles_duplicate, 16, 4);
  CHECK_LAYOUT(nade_mesh_report, triangles_turned, 20, 4);
  CHECK_LAYOUT(nade_mesh_report, border_edges, 24, 4);
  CHECK_LAYOUT(nade_mesh_report, nonmanifold_edges, 28, 4);
  CHECK(sizeof(nade_surface_point) == 56);
  CHECK_LAYOUT(nade_surface_point, point, 0, 24);
  CHECK_LAYOUT(nade_surface_point, normal, 24, 24);
  CHECK_LAYOUT(nade_surface_point, signed_distance, 48, 8);
  CHECK(sizeof(nade_ray_hit) == 56);
  CHECK_LAYOUT(nade_ray_hit, point, 0, 24);
  CHECK_LAYOUT(nade_ray_hit, normal, 24, 24);
  CHECK_LAYOUT(nade_ray_hit, distance, 48, 8);
}

/* Structs with pointers, where these have 8 bytes. */
static void check_layouts_with_pointers(void) {
  if (sizeof(void*) != 8) return;
  CHECK(sizeof(nade_corrector_options) == 48);
  CHECK_LAYOUT(nade_corrector_options, size, 0, 4);
  CHECK_LAYOUT(nade_corrector_options, method, 4, 4);
  CHECK_LAYOUT(nade_corrector_options, release_s, 8, 8);
  CHECK_LAYOUT(nade_corrector_options, hand_length_m, 16, 8);
  CHECK_LAYOUT(nade_corrector_options, feel, 24, 8);
  CHECK_LAYOUT(nade_corrector_options, left_flesh, 32, 8);
  CHECK_LAYOUT(nade_corrector_options, right_flesh, 40, 8);
  CHECK(sizeof(nade_mesh) == 40);
  CHECK_LAYOUT(nade_mesh, size, 0, 4);
  CHECK_LAYOUT(nade_mesh, vertex_count, 4, 4);
  CHECK_LAYOUT(nade_mesh, triangle_count, 8, 4);
  CHECK_LAYOUT(nade_mesh, scale, 12, 12);
  CHECK_LAYOUT(nade_mesh, vertices, 24, 8);
  CHECK_LAYOUT(nade_mesh, triangles, 32, 8);
  CHECK(sizeof(nade_surface_callbacks) == 56);
  CHECK_LAYOUT(nade_surface_callbacks, size, 0, 4);
  CHECK_LAYOUT(nade_surface_callbacks, reserved, 4, 4);
  CHECK_LAYOUT(nade_surface_callbacks, user, 8, 8);
  CHECK_LAYOUT(nade_surface_callbacks, closest_point, 16, 8);
  CHECK_LAYOUT(nade_surface_callbacks, first_hit, 24, 8);
  CHECK_LAYOUT(nade_surface_callbacks, shape, 32, 8);
  CHECK_LAYOUT(nade_surface_callbacks, bounds, 40, 8);
  CHECK_LAYOUT(nade_surface_callbacks, release, 48, 8);
  CHECK(sizeof(nade_group_member) == 40);
  CHECK_LAYOUT(nade_group_member, surface, 0, 8);
  CHECK_LAYOUT(nade_group_member, placement, 8, 32);
  CHECK(sizeof(nade_hand_mesh) == 64);
  CHECK_LAYOUT(nade_hand_mesh, size, 0, 4);
  CHECK_LAYOUT(nade_hand_mesh, side, 4, 4);
  CHECK_LAYOUT(nade_hand_mesh, vertex_count, 8, 4);
  CHECK_LAYOUT(nade_hand_mesh, triangle_count, 12, 4);
  CHECK_LAYOUT(nade_hand_mesh, vertices, 16, 8);
  CHECK_LAYOUT(nade_hand_mesh, normals, 24, 8);
  CHECK_LAYOUT(nade_hand_mesh, triangles, 32, 8);
  CHECK_LAYOUT(nade_hand_mesh, bones, 40, 8);
  CHECK_LAYOUT(nade_hand_mesh, weights, 48, 8);
  CHECK_LAYOUT(nade_hand_mesh, bind, 56, 8);
}

static void check_library(void) {
  CHECK(nade_abi_version() == NADE_ABI_VERSION);
  CHECK(strchr(nade_version(), '.') != NULL);
  CHECK(nade_has(NADE_CAN_CORRECT) == 1);
  CHECK(nade_has(NADE_CAN_RECORD) == 0);
  CHECK(nade_has(-1) == 0);
  for (int i = 3; i > -10; --i) CHECK(strlen(nade_status_text(i)) > 0);
  for (int i = -1; i < 8; ++i) CHECK(strlen(nade_fault_text(i)) > 0);
  CHECK(strcmp(nade_last_error(), "") == 0);
}

typedef struct {
  int count;
  nade_status status;
  char sentence[256];
} messages;

static void keep_message(void* user, nade_status status, const char* sentence) {
  messages* const kept = user;
  ++kept->count;
  kept->status = status;
  strcpy(kept->sentence, sentence);
}

static void check_messages(void) {
  messages kept = {0};
  nade_surface* surface = NULL;
  nade_set_message_callback(keep_message, &kept);
  CHECK(nade_surface_create_sphere(-1.0f, &surface) == NADE_ERROR_ARGUMENT);
  CHECK(surface == NULL);
  CHECK(kept.count == 1 && kept.status == NADE_ERROR_ARGUMENT);
  CHECK(strcmp(kept.sentence,
               "nade_surface_create_sphere: radius_m: expected a number above 0, found -1") == 0);
  CHECK(strcmp(nade_last_error(), kept.sentence) == 0);
  nade_set_message_callback(NULL, NULL);
  CHECK(nade_surface_create_plane(NULL) == NADE_ERROR_ARGUMENT);
  CHECK(kept.count == 1);
}

static void check_wrong_surfaces(void) {
  const double half[3] = {0.1, 0.2, 0.3};
  const double bad_half[3] = {0.1, NAN, 0.3};
  const float outline[6] = {0, 0, 1, 0, 0, 1};
  const float line[6] = {0, 0, 1, 0, 2, 0};
  const float flat[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const float heights[4] = {0, 0, 0, NAN};
  nade_surface* made = NULL;
  CHECK(nade_surface_create_sphere(NAN, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_sphere(INFINITY, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_sphere(1, NULL) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_ellipsoid(NULL, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_ellipsoid(bad_half, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_box(bad_half, 0, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_box(half, 0.11, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_box(half, NAN, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_box(NULL, 0, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_cylinder(0.1, 0, 0, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_cylinder(0.1, 0.2, 0.15, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_capsule(-0.1, 0.2, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_capsule(0.1, 0, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_plate(outline, 2, 0.1, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_plate(line, 3, 0.1, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_plate(outline, 3, 0, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_plate(NULL, 3, 0.1, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_hull(flat, 3, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_hull(flat, 4, &made) == NADE_ERROR_DATA);
  CHECK(nade_surface_create_height_field(heights, 2, 2, 0.1, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_height_field(heights, 1, 2, 0.1, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_height_field(heights, SIZE_MAX, 2, 1, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_group(NULL, 1, &made) == NADE_ERROR_ARGUMENT);
  CHECK(made == NULL);
  CHECK_OK(nade_surface_create_plate(outline, 3, 0.1, &made));
  CHECK(nade_surface_refit(made, outline, 2) == NADE_ERROR_HANDLE);
  CHECK(nade_surface_place_member(made, 0, NULL) == NADE_ERROR_HANDLE);
  CHECK(nade_scene_destroy((nade_scene*)made) == NADE_ERROR_HANDLE);
  CHECK_OK(nade_surface_destroy(made));
  CHECK(nade_surface_destroy(made) == NADE_ERROR_HANDLE);
  CHECK_OK(nade_surface_destroy(NULL));
}

static void check_wrong_meshes(void) {
  const float vertices[9] = {0, 0, 0, 1, 0, 0, 0, 0, -1};
  const float moved[9] = {0, 0, 0, 1, 0, 0, 0, NAN, -1};
  const uint32_t triangle[3] = {0, 1, 2};
  const uint32_t beyond[3] = {0, 1, 3};
  nade_surface* made = NULL;
  nade_mesh mesh = {.size = sizeof mesh};
  nade_mesh_report report = {.size = sizeof report};
  CHECK(nade_surface_create_mesh(NULL, NULL, &made) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_create_mesh(&mesh, NULL, &made) == NADE_ERROR_ARGUMENT);
  mesh.vertex_count = 3;
  mesh.triangle_count = 1;
  mesh.vertices = vertices;
  mesh.triangles = beyond;
  CHECK(nade_surface_create_mesh(&mesh, NULL, &made) == NADE_ERROR_DATA);
  mesh.triangles = triangle;
  mesh.scale[0] = 1;
  CHECK(nade_surface_create_mesh(&mesh, NULL, &made) == NADE_ERROR_ARGUMENT);
  mesh.scale[1] = mesh.scale[2] = 2;
  mesh.size = 7;
  CHECK(nade_surface_create_mesh(&mesh, NULL, &made) == NADE_ERROR_SIZE);
  mesh.size = sizeof mesh;
  report.size = 3;
  CHECK(nade_surface_create_mesh(&mesh, &report, &made) == NADE_ERROR_SIZE);
  CHECK(made == NULL);
  report.size = sizeof report;
  CHECK_OK(nade_surface_create_mesh(&mesh, &report, &made));
  CHECK(report.solid == NADE_SOLID_SHEET && report.triangles_used == 1 && report.border_edges == 3);
  CHECK(nade_surface_refit(made, vertices, 2) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_refit(made, moved, 3) == NADE_ERROR_ARGUMENT);
  CHECK(nade_surface_refit(made, NULL, 3) == NADE_ERROR_ARGUMENT);
  CHECK_OK(nade_surface_refit(made, vertices, 3));
  CHECK_OK(nade_surface_destroy(made));
}

static void check_wrong_scenes(void) {
  const nade_placement turned_nan = {{0, 0, NAN, 1}, {0, 0, 0}, 1};
  const nade_placement no_turn = {{0, 0, 0, 0}, {0, 0, 0}, 1};
  const nade_placement mirrored = {{0, 0, 0, 1}, {0, 0, 0}, -1};
  nade_feel feel = {.size = sizeof feel};
  nade_scene* scene = NULL;
  nade_surface* plane = NULL;
  size_t size = 9;
  CHECK_OK(nade_scene_create(&scene));
  CHECK_OK(nade_surface_create_plane(&plane));
  CHECK(nade_scene_create(NULL) == NADE_ERROR_ARGUMENT);
  CHECK(nade_scene_add(NULL, 1, plane, NULL, NULL) == NADE_ERROR_HANDLE);
  CHECK(nade_scene_add(scene, 1, NULL, NULL, NULL) == NADE_ERROR_HANDLE);
  CHECK(nade_scene_add(scene, 1, plane, &turned_nan, NULL) == NADE_ERROR_ARGUMENT);
  CHECK(nade_scene_add(scene, 1, plane, &no_turn, NULL) == NADE_ERROR_ARGUMENT);
  CHECK(nade_scene_add(scene, 1, plane, &mirrored, NULL) == NADE_ERROR_ARGUMENT);
  CHECK(nade_scene_add(scene, 1, plane, NULL, &feel) == NADE_ERROR_ARGUMENT);
  CHECK_OK(nade_feel_init(&feel));
  feel.softness_m = 0.03;
  CHECK(nade_scene_add(scene, 1, plane, NULL, &feel) == NADE_ERROR_ARGUMENT);
  CHECK(strstr(nade_last_error(), "softness_m") != NULL);
  feel.softness_m = 0.02;
  CHECK_OK(nade_scene_add(scene, 1, plane, NULL, &feel));
  CHECK(nade_scene_add(scene, 1, plane, NULL, NULL) == NADE_ERROR_ID);
  CHECK(nade_scene_place(scene, 2, NULL) == NADE_ERROR_ID);
  CHECK(nade_scene_place(scene, 1, &turned_nan) == NADE_ERROR_ARGUMENT);
  CHECK(nade_scene_deformed(scene, 2) == NADE_ERROR_ID);
  CHECK(nade_scene_set_feel(scene, 2, NULL) == NADE_ERROR_ID);
  feel.friction = NAN;
  CHECK(nade_scene_set_feel(scene, 1, &feel) == NADE_ERROR_ARGUMENT);
  CHECK(nade_scene_remove(scene, 2) == NADE_ERROR_ID);
  CHECK(nade_scene_size(scene, NULL) == NADE_ERROR_ARGUMENT);
  CHECK_OK(nade_scene_size(scene, &size));
  CHECK(size == 1);
  CHECK_OK(nade_scene_remove(scene, 1));
  CHECK_OK(nade_surface_destroy(plane));
  CHECK(nade_scene_add(scene, 1, plane, NULL, NULL) == NADE_ERROR_HANDLE);
  CHECK_OK(nade_scene_destroy(scene));
  CHECK(nade_scene_size(scene, &size) == NADE_ERROR_HANDLE);
}

static void check_wrong_options(void) {
  nade_corrector* corrector = NULL;
  nade_corrector_options options = {.size = sizeof options};
  CHECK_OK(nade_corrector_options_init(&options));
  CHECK(options.method == NADE_METHOD_NADE && options.feel == NULL);
  CHECK_OK(nade_corrector_options_check(&options));
  CHECK_OK(nade_corrector_options_check(NULL));
  options.method = 3;
  CHECK(nade_corrector_create(&options, &corrector) == NADE_ERROR_ARGUMENT);
  options.method = NADE_METHOD_PAPER;
  options.release_s = NAN;
  CHECK(nade_corrector_create(&options, &corrector) == NADE_ERROR_ARGUMENT);
  CHECK(strstr(nade_last_error(), "release_s") != NULL);
  CHECK(nade_corrector_create(NULL, NULL) == NADE_ERROR_ARGUMENT);
  CHECK(corrector == NULL);
}

static void check_wrong_frames(void) {
  nade_corrector* corrector = NULL;
  nade_scene* scene = NULL;
  nade_surface* plane = NULL;
  nade_joint joints[NADE_JOINT_COUNT];
  nade_result result = {.size = sizeof result};
  nade_result before;
  CHECK_OK(nade_corrector_create(NULL, &corrector));
  CHECK_OK(nade_scene_create(&scene));
  CHECK_OK(nade_surface_create_plane(&plane));
  CHECK(nade_rest_hand(2, joints) == NADE_ERROR_ARGUMENT);
  CHECK(nade_rest_hand(NADE_LEFT, NULL) == NADE_ERROR_ARGUMENT);
  CHECK_OK(nade_rest_hand(NADE_LEFT, joints));
  CHECK_OK(nade_corrector_update(corrector, NADE_LEFT, joints, plane, NULL, 0, 0, &result));
  before = result;
  CHECK(nade_corrector_update(NULL, NADE_LEFT, joints, plane, NULL, 0, 0, &result) ==
        NADE_ERROR_HANDLE);
  CHECK(nade_corrector_update(corrector, -1, joints, plane, NULL, 0, 0, &result) ==
        NADE_ERROR_ARGUMENT);
  CHECK(nade_corrector_update(corrector, NADE_LEFT, NULL, plane, NULL, 0, 0, &result) ==
        NADE_ERROR_ARGUMENT);
  CHECK(nade_corrector_update(corrector, NADE_LEFT, joints, plane, NULL, 0, 0, NULL) ==
        NADE_ERROR_ARGUMENT);
  CHECK(nade_corrector_update_scene(corrector, NADE_LEFT, joints, NULL, 0, &result) ==
        NADE_ERROR_HANDLE);
  CHECK(nade_corrector_preview(corrector, NADE_LEFT, joints, NULL) == NADE_ERROR_ARGUMENT);
  CHECK(memcmp(&before, &result, sizeof result) == 0);
  result.size = 0;
  CHECK(nade_corrector_update(corrector, NADE_LEFT, joints, plane, NULL, 0, 0, &result) ==
        NADE_ERROR_SIZE);
  result.size = sizeof result;

  /* A hand that cannot be used comes back as it is. */
  joints[NADE_JOINT_INDEX_TIP].position[1] = NAN;
  CHECK_OK(nade_corrector_update(corrector, NADE_LEFT, joints, plane, NULL, 0, 1, &result));
  CHECK(result.status == NADE_HAND_UNTRACKED && result.fault == NADE_FAULT_NOT_FINITE);
  CHECK(memcmp(result.joints, joints, sizeof joints) == 0);
  CHECK_OK(nade_corrector_update_scene(corrector, NADE_LEFT, joints, scene, 2, &result));
  CHECK(result.status == NADE_HAND_UNTRACKED);
  CHECK_OK(nade_corrector_preview(corrector, NADE_LEFT, joints, joints));
  CHECK(isnan(joints[NADE_JOINT_INDEX_TIP].position[1]));

  CHECK_OK(nade_corrector_reset(corrector));
  CHECK_OK(nade_scene_destroy(scene));
  CHECK_OK(nade_surface_destroy(plane));
  CHECK_OK(nade_corrector_destroy(corrector));
  CHECK(nade_corrector_reset(corrector) == NADE_ERROR_HANDLE);
  CHECK(nade_corrector_update_scene(corrector, NADE_LEFT, joints, scene, 3, &result) ==
        NADE_ERROR_HANDLE);
  CHECK(nade_corrector_destroy(corrector) == NADE_ERROR_HANDLE);
}

static void check_wrong_fleshes(void) {
  nade_flesh* flesh = NULL;
  nade_joint bind[NADE_JOINT_COUNT];
  const float vertices[9] = {0, 0, 0, 0.01f, 0, 0, 0, 0, -0.01f};
  const float normals[9] = {0, 1, 0, 0, 1, 0, 0, 1, 0};
  const uint32_t triangle[3] = {0, 1, 2};
  const uint8_t bones[12] = {1, 0, 0, 0, 1, 0, 0, 0, 26, 0, 0, 0};
  const float weights[12] = {1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0};
  nade_hand_mesh mesh = {.size = sizeof mesh, .side = NADE_RIGHT};
  CHECK(nade_flesh_create(&mesh, &flesh) == NADE_ERROR_ARGUMENT);
  CHECK_OK(nade_rest_hand(NADE_RIGHT, bind));
  mesh.vertex_count = 3;
  mesh.triangle_count = 1;
  mesh.vertices = vertices;
  mesh.normals = normals;
  mesh.triangles = triangle;
  mesh.bones = bones;
  mesh.weights = weights;
  mesh.bind = bind;
  CHECK(nade_flesh_create(&mesh, &flesh) == NADE_ERROR_DATA);
  CHECK(strstr(nade_last_error(), "bones") != NULL);
  mesh.bones = (const uint8_t*)"\1\1\1\1\1\1\1\1\1\1\1\1";
  CHECK(nade_flesh_create(&mesh, &flesh) == NADE_ERROR_DATA);
  CHECK(strstr(nade_last_error(), "weights") != NULL);
  mesh.vertex_count = 0;
  CHECK(nade_flesh_create(&mesh, &flesh) == NADE_ERROR_ARGUMENT);
  CHECK(flesh == NULL);
  CHECK_OK(nade_flesh_destroy(flesh));
}

/* A hand with some skin at its wrist and its middle finger's tip. */
static void check_skins(void) {
  nade_skin* skin = NULL;
  nade_surface* plane = NULL;
  nade_scene* scene = NULL;
  nade_joint joints[NADE_JOINT_COUNT];
  float vertices[18];
  float normals[18] = {0};
  float posed[18];
  const uint32_t triangles[6] = {0, 1, 2, 3, 4, 5};
  const uint8_t bones[24] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 15, 0, 0, 0, 15, 0, 0, 0, 15};
  float weights[24] = {0};
  nade_hand_mesh mesh = {.size = sizeof mesh, .side = NADE_LEFT};
  CHECK(nade_skin_create(&mesh, &skin) == NADE_ERROR_ARGUMENT);
  CHECK(nade_skin_create(NULL, &skin) == NADE_ERROR_ARGUMENT);
  CHECK(nade_skin_create(&mesh, NULL) == NADE_ERROR_ARGUMENT);
  CHECK_OK(nade_rest_hand(NADE_LEFT, joints));
  for (int i = 0; i < 6; ++i) {
    const float* const at = joints[i < 3 ? NADE_JOINT_WRIST : NADE_JOINT_MIDDLE_TIP].position;
    for (int k = 0; k < 3; ++k) vertices[3 * i + k] = at[k];
    vertices[3 * i] += 0.004f * (float)(i % 3 == 1);
    vertices[3 * i + 1] -= 0.008f;
    vertices[3 * i + 2] -= 0.004f * (float)(i % 3 == 2);
    normals[3 * i + 1] = -1;
    weights[4 * i] = 1;
  }
  mesh.vertex_count = 6;
  mesh.triangle_count = 2;
  mesh.vertices = vertices;
  mesh.normals = normals;
  mesh.triangles = triangles;
  mesh.bones = bones;
  mesh.weights = weights;
  mesh.bind = joints;
  CHECK_OK(nade_skin_create(&mesh, &skin));
  CHECK_OK(nade_surface_create_plane(&plane));
  CHECK_OK(nade_scene_create(&scene));
  CHECK_OK(nade_scene_add(scene, 1, plane, NULL, NULL));

  /* The fingertip's skin 2 mm below y = 0. */
  const float down = 0.006f - joints[NADE_JOINT_MIDDLE_TIP].position[1];
  for (int i = 0; i < NADE_JOINT_COUNT; ++i) joints[i].position[1] += down;
  CHECK_OK(nade_skin_pose(skin, joints, 1, posed, NULL, 6));
  CHECK(fabsf(posed[10] + 0.002f) < 1e-6f);
  for (int way = 0; way < 3; ++way) {
    memcpy(vertices, posed, sizeof posed);
    if (way == 0) CHECK_OK(nade_skin_flatten(skin, joints, 1, plane, NULL, 0, vertices, NULL, 6));
    if (way == 1)
      CHECK_OK(nade_skin_flatten_scene(skin, joints, 1, scene, 0, vertices, normals, 6));
    if (way == 2) CHECK_OK(nade_skin_flatten(skin, joints, 1, NULL, NULL, 0, vertices, normals, 6));
    CHECK(way == 2 ? memcmp(vertices, posed, sizeof posed) == 0 : vertices[10] > 0.0001f);
  }

  CHECK(nade_skin_pose(NULL, joints, 1, vertices, NULL, 6) == NADE_ERROR_HANDLE);
  CHECK(nade_skin_pose(skin, NULL, 1, vertices, NULL, 6) == NADE_ERROR_ARGUMENT);
  CHECK(nade_skin_pose(skin, joints, 0, vertices, NULL, 6) == NADE_ERROR_ARGUMENT);
  CHECK(nade_skin_pose(skin, joints, NAN, vertices, NULL, 6) == NADE_ERROR_ARGUMENT);
  CHECK(nade_skin_pose(skin, joints, 1, NULL, normals, 6) == NADE_ERROR_ARGUMENT);
  CHECK(nade_skin_pose(skin, joints, 1, vertices, normals, 5) == NADE_ERROR_ARGUMENT);
  CHECK(strstr(nade_last_error(), "vertex_count: expected 6, as the mesh has, found 5") != NULL);
  CHECK(nade_skin_flatten(skin, joints, 1, plane, NULL, -1, vertices, NULL, 6) ==
        NADE_ERROR_ARGUMENT);
  CHECK(nade_skin_flatten(skin, joints, 1, plane, NULL, NAN, vertices, NULL, 6) ==
        NADE_ERROR_ARGUMENT);
  CHECK(nade_skin_flatten_scene(skin, joints, 1, NULL, 0, vertices, NULL, 6) == NADE_ERROR_HANDLE);
  normals[4] = NAN;
  CHECK(nade_skin_flatten_scene(skin, joints, 1, scene, 0, vertices, normals, 6) ==
        NADE_ERROR_ARGUMENT);
  joints[NADE_JOINT_WRIST].position[2] = INFINITY;
  CHECK(nade_skin_flatten(skin, joints, 1, plane, NULL, 0, vertices, NULL, 6) == NADE_ERROR_DATA);
  CHECK(strstr(nade_last_error(), "joints: ") != NULL);
  CHECK(memcmp(vertices, posed, sizeof posed) == 0);

  CHECK_OK(nade_surface_destroy(plane)); /* the skin keeps it */
  CHECK_OK(nade_scene_destroy(scene));
  CHECK_OK(nade_skin_destroy(skin));
  CHECK(nade_skin_destroy(skin) == NADE_ERROR_HANDLE);
}

/* The half-space below y = 0, once more. */
static int32_t closest_on_floor(void* user, const double query[3], double max_distance,
                                uint32_t* hint, nade_surface_point* point) {
  ++*(int*)user;
  *hint = 7;
  if (fabs(query[1]) > max_distance) return 0;
  *point = (nade_surface_point){{query[0], 0, query[2]}, {0, 2, 0}, query[1]};
  return 1;
}

static void count_release(void* user) { *(int*)user = -1; }

/* Presses a hand of NADE_RIGHT onto what is below y = 0. */
static void stroke(const nade_surface* surface, const nade_scene* scene, nade_result* result) {
  nade_corrector* corrector = NULL;
  nade_joint rest[NADE_JOINT_COUNT];
  nade_joint tracked[NADE_JOINT_COUNT];
  CHECK_OK(nade_corrector_create(NULL, &corrector));
  CHECK_OK(nade_rest_hand(NADE_RIGHT, rest));
  for (int frame = 0; frame <= 60; ++frame) {
    const int64_t time_ns = frame * INT64_C(11111111);
    memcpy(tracked, rest, sizeof tracked);
    for (int i = 0; i < NADE_JOINT_COUNT; ++i) {
      tracked[i].position[1] += 0.08f - 0.1f * (float)frame / 60.0f;
    }
    if (scene == NULL) {
      CHECK_OK(
          nade_corrector_update(corrector, NADE_RIGHT, tracked, surface, NULL, 5, time_ns, result));
    } else {
      CHECK_OK(nade_corrector_update_scene(corrector, NADE_RIGHT, tracked, scene, time_ns, result));
    }
  }
  CHECK(result->status == NADE_HAND_CORRECTED);
  CHECK(result->joints[NADE_JOINT_PALM].position[1] > tracked[NADE_JOINT_PALM].position[1]);
  CHECK(result->contact_count > 0 && result->contact_count <= NADE_MAX_CONTACTS);
  CHECK(result->contacts[0].object == 5);
  nade_joint drawn[NADE_JOINT_COUNT];
  CHECK_OK(nade_corrector_preview(corrector, NADE_RIGHT, tracked, drawn));
  CHECK(fabsf(drawn[0].position[1] - result->joints[0].position[1]) < 1e-6f);
  CHECK_OK(nade_corrector_destroy(corrector));
}

static void check_strokes(void) {
  int calls = 0;
  nade_surface* plane = NULL;
  nade_surface* own = NULL;
  nade_scene* scene = NULL;
  nade_surface_callbacks callbacks = {.size = sizeof callbacks, .user = &calls};
  nade_result on_plane = {.size = sizeof on_plane};
  nade_result on_own = {.size = sizeof on_own};
  nade_result in_scene = {.size = sizeof in_scene};
  CHECK_OK(nade_surface_create_plane(&plane));
  CHECK(nade_surface_create_custom(&callbacks, &own) == NADE_ERROR_ARGUMENT);
  callbacks.closest_point = closest_on_floor;
  callbacks.release = count_release;
  CHECK_OK(nade_surface_create_custom(&callbacks, &own));
  CHECK_OK(nade_scene_create(&scene));
  CHECK_OK(nade_scene_add(scene, 5, plane, NULL, NULL));
  CHECK_OK(nade_surface_destroy(plane)); /* the scene keeps it */
  CHECK_OK(nade_surface_create_plane(&plane));
  stroke(plane, NULL, &on_plane);
  stroke(own, NULL, &on_own);
  stroke(NULL, scene, &in_scene);
  CHECK(calls > 0);
  for (int i = 0; i < NADE_JOINT_COUNT; ++i) {
    for (int k = 0; k < 3; ++k) {
      CHECK(fabsf(on_plane.joints[i].position[k] - on_own.joints[i].position[k]) < 1e-6f);
      CHECK(fabsf(on_plane.joints[i].position[k] - in_scene.joints[i].position[k]) < 1e-6f);
    }
  }
  CHECK_OK(nade_surface_destroy(own));
  CHECK(calls == -1);
  CHECK_OK(nade_surface_destroy(plane));
  CHECK_OK(nade_scene_destroy(scene));
}

int main(void) {
  check_layouts();
  check_layouts_with_pointers();
  check_library();
  check_messages();
  check_wrong_surfaces();
  check_wrong_meshes();
  check_wrong_scenes();
  check_wrong_options();
  check_wrong_frames();
  check_wrong_fleshes();
  check_skins();
  check_strokes();
  if (failures == 0) printf("all well\n");
  return failures == 0 ? 0 : 1;
}
