/* nade in C: keeps a tracked hand on the surface it strokes. C99 or C++.
 *
 *   nade_corrector* corrector = NULL;
 *   nade_surface* table = NULL;
 *   nade_result result = {.size = sizeof result};
 *   nade_corrector_create(NULL, &corrector);
 *   nade_surface_create_plane(&table);
 *   for each frame, of one hand:
 *     nade_corrector_update(corrector, NADE_RIGHT, joints, table, NULL, 0, time_ns, &result);
 *     draw result.joints
 *
 * Units and frames. Metres, seconds, radians; right-handed, +Y up. World coordinates, wherever the
 * program has its origin. Quaternions are x y z w; lengths from 0.5 to 2 are made unit. A hand has
 * 26 joints in the order of XrHandJointEXT, in frames as OpenXR has them: -Z to the fingertip, +Y
 * to the back of the hand, for both hands. Times are nanoseconds of any origin.
 *
 * Hands, placements and vertices are floats, as engines have them; sizes and options are doubles,
 * as written. Correction is in doubles: the same hand as by the C++ classes, rounded.
 *
 * Errors. Every function that can fail returns a nade_status: NADE_OK, or a negative code;
 * nade_last_error() has the sentence, which names the argument. A call that failed has changed
 * nothing, what it would have written included. Nothing is thrown, printed or stopped.
 *
 * Handles. nade_surface, nade_scene, nade_flesh, nade_skin and nade_corrector come from their
 * `create` and go by their `destroy`. What still uses another keeps it: a surface may be destroyed
 * while it is in a scene, and is freed when the last that uses it goes. A handle that was destroyed
 * is told (NADE_ERROR_HANDLE) until its place is taken again, 64 or more destroyed handles of its
 * kind later; a pointer that never was a handle is not told. NULL may be destroyed.
 *
 * Structs. Those that begin with `size` may grow: set it to sizeof the struct before each use. The
 * library takes any size that ends with one of its fields, at least the first after `size`; fields
 * that are missing have their default, or are not written. A longer struct, of a newer header, is
 * taken if what is beyond the known fields is all 0; of one that is written that is set to 0.
 * (No more than 4096 bytes of it: so a size that was never set is told.) The others never change.
 *
 * Memory. Arrays that are passed are read during the call and not kept. Functions that a program
 * calls in every frame say that they do not allocate.
 *
 * Threads. Any function may be called by any thread. A handle is used by one at a time, but any
 * number of correctors may run at once on surfaces, scenes and fleshes that they share, while none
 * of these is changed (refit, placed, added to, removed from). Creating and destroying is safe
 * beside everything that does not use the same handle.
 *
 * Stability. What is here stays as it is while NADE_ABI_VERSION stays; functions, fields and
 * values may be added.
 */
#ifndef NADE_H
#define NADE_H

#include <stddef.h>
#include <stdint.h>

#define NADE_ABI_VERSION 1

#if defined(_WIN32) && defined(NADE_C_BUILDS)
#define NADE_API __declspec(dllexport)
#elif defined(_WIN32) && !defined(NADE_C_STATIC)
#define NADE_API __declspec(dllimport)
#elif defined(__GNUC__)
#define NADE_API __attribute__((visibility("default")))
#else
#define NADE_API
#endif

#ifdef __cplusplus
#define NADE_NOEXCEPT noexcept
extern "C" {
#else
#define NADE_NOEXCEPT
#endif

/* --- Codes ---------------------------------------------------------------------------------- */

typedef int32_t nade_status;
enum {
  NADE_OK = 0,
  NADE_ERROR_ARGUMENT = -1, /* NULL, not finite, or out of range */
  NADE_ERROR_HANDLE = -2,   /* NULL, destroyed, or of another kind */
  NADE_ERROR_SIZE = -3,     /* a struct's size is none that the library knows */
  NADE_ERROR_ID = -4,       /* an object's id is taken, or there is none of that id */
  NADE_ERROR_DATA = -5,     /* a mesh, hull, height field or hand mesh that cannot be used */
  NADE_ERROR_MEMORY = -6,
  NADE_ERROR_INTERNAL = -7 /* a bug in nade */
};

/* A part of the interface that a library may lack; values may be added. */
typedef int32_t nade_capability;
enum {
  NADE_CAN_CORRECT = 0, /* this header, as of NADE_ABI_VERSION 1 */
  NADE_CAN_RECORD = 1   /* recordings: never, a second library has them, nade_io.h */
};

typedef int32_t nade_side;
enum { NADE_LEFT = 0, NADE_RIGHT = 1 };

typedef int32_t nade_method;
enum {
  NADE_METHOD_NONE = 0,  /* the tracked hand, bit for bit */
  NADE_METHOD_PAPER = 1, /* palm and fingertips are moved out (2023), the baseline */
  NADE_METHOD_NADE = 2   /* a proxy hand with soft flesh lies on the surface; the default */
};

/* What became of a tracked hand. */
typedef int32_t nade_hand_status;
enum {
  NADE_HAND_FREE = 0,      /* nothing touched: the tracked hand, bit for bit */
  NADE_HAND_CORRECTED = 1, /* some part rests on an object, or is braked to land on it */
  NADE_HAND_RELEASED = 2,  /* nothing touched any more, what was left of a correction fades */
  NADE_HAND_UNTRACKED = 3  /* the hand could not be used, see nade_fault: as it was passed */
};

/* Why a hand could not be used. */
typedef int32_t nade_fault;
enum {
  NADE_FAULT_NONE = 0,
  NADE_FAULT_NOT_FINITE = 1,        /* a number of a joint is not finite */
  NADE_FAULT_ROTATION_NOT_UNIT = 2, /* a rotation's length is not 0.5 to 2 */
  NADE_FAULT_WRIST_FAR = 3,         /* the wrist is 1000 km or more from the origin */
  NADE_FAULT_JOINT_FAR = 4,         /* a joint is half a metre or more from the wrist */
  NADE_FAULT_NO_LENGTH = 5          /* wrist and middle knuckle less than a millimetre apart */
};

/* How a mesh tells inside from outside. */
typedef int32_t nade_solid;
enum {
  NADE_SOLID_CLOSED = 0,    /* clean and closed */
  NADE_SOLID_DEFECTIVE = 1, /* with holes or doubled parts: solid as a film across them has it */
  NADE_SOLID_SHEET = 2      /* open, and faces mostly one way: solid behind it */
};

/* As XrHandJointEXT. */
enum {
  NADE_JOINT_PALM = 0,
  NADE_JOINT_WRIST = 1,
  NADE_JOINT_THUMB_METACARPAL = 2,
  NADE_JOINT_THUMB_PROXIMAL = 3,
  NADE_JOINT_THUMB_DISTAL = 4,
  NADE_JOINT_THUMB_TIP = 5,
  NADE_JOINT_INDEX_METACARPAL = 6,
  NADE_JOINT_INDEX_PROXIMAL = 7,
  NADE_JOINT_INDEX_INTERMEDIATE = 8,
  NADE_JOINT_INDEX_DISTAL = 9,
  NADE_JOINT_INDEX_TIP = 10,
  NADE_JOINT_MIDDLE_METACARPAL = 11,
  NADE_JOINT_MIDDLE_PROXIMAL = 12,
  NADE_JOINT_MIDDLE_INTERMEDIATE = 13,
  NADE_JOINT_MIDDLE_DISTAL = 14,
  NADE_JOINT_MIDDLE_TIP = 15,
  NADE_JOINT_RING_METACARPAL = 16,
  NADE_JOINT_RING_PROXIMAL = 17,
  NADE_JOINT_RING_INTERMEDIATE = 18,
  NADE_JOINT_RING_DISTAL = 19,
  NADE_JOINT_RING_TIP = 20,
  NADE_JOINT_LITTLE_METACARPAL = 21,
  NADE_JOINT_LITTLE_PROXIMAL = 22,
  NADE_JOINT_LITTLE_INTERMEDIATE = 23,
  NADE_JOINT_LITTLE_DISTAL = 24,
  NADE_JOINT_LITTLE_TIP = 25,
  NADE_JOINT_COUNT = 26
};

enum {
  NADE_MAX_CONTACTS = 16, /* of a hand in a frame */
  NADE_MAX_GROUP_MEMBERS = 255
};

/* --- Structs -------------------------------------------------------------------------------- */

typedef struct nade_surface nade_surface;
typedef struct nade_scene nade_scene;
typedef struct nade_flesh nade_flesh;
typedef struct nade_corrector nade_corrector;
typedef struct nade_skin nade_skin;

/* A joint: an XrPosef and a radius, 32 bytes. */
typedef struct nade_joint {
  float rotation[4]; /* x y z w */
  float position[3];
  float radius; /* joint to skin, 0 where the tracker does not know it; passed through */
} nade_joint;

/* Where an object stands: scaled, turned, moved. 32 bytes. NULL stands for no motion, scale 1. */
typedef struct nade_placement {
  float rotation[4]; /* x y z w */
  float position[3];
  float scale; /* the same along all axes, above 0; 0 hides the object. For others see the shapes */
} nade_placement;

/* What an object is like under the hand. NULL stands for the defaults: hard, without friction. */
typedef struct nade_feel {
  uint32_t size;
  uint32_t reserved;       /* 0 */
  double softness_m;       /* the skin sinks in so far at the most, 0 to 0.02; default 0 */
  double softness_depth_m; /* pressing so deep sinks by two thirds of that, above 0; default 0.02 */
  double friction;         /* lag over pressing depth at which the hand slips, 0 to 2; default 0 */
  double friction_kinetic; /* share of the lag that is left while it slips, 0 to 1; default 0.6 */
  double longest_lag_m;    /* whatever the depth; default 0.03 */
} nade_feel;

typedef struct nade_corrector_options {
  uint32_t size;
  nade_method method; /* default NADE_METHOD_NADE */
  double release_s;   /* what cannot be continuous fades over this time, 0 to 1; default 0.2 */
  /* Wrist to middle knuckle of the hand that is drawn, where it is known, below 0.5; 0, the
   * default: what the tracker says on the average. */
  double hand_length_m;
  const nade_feel* feel;         /* of objects outside of a scene; NULL, the default */
  const nade_flesh* left_flesh;  /* of the left hand that is drawn; NULL: the built-in hand's */
  const nade_flesh* right_flesh; /* of the right one */
} nade_corrector_options;

/* Skin of one bone that touches. 56 bytes. */
typedef struct nade_contact {
  uint64_t object;       /* id in the scene; outside of one the `object` of nade_corrector_update */
  int32_t bone;          /* the joint at a phalanx's base, as NADE_JOINT_INDEX_INTERMEDIATE;
                            NADE_JOINT_THUMB_METACARPAL; or NADE_JOINT_PALM for all the rest */
  float depth_m;         /* of the person's skin in the object, 0 or more: how it presses */
  float point[3];        /* on the surface */
  float normal[3];       /* unit, out of the solid */
  float velocity_mps[3]; /* of the drawn skin there against the object */
  uint32_t reserved;     /* 0 */
} nade_contact;

/* A corrected hand, in the tracked hand's frame. */
typedef struct nade_result {
  uint32_t size;
  nade_hand_status status;
  nade_fault fault;
  uint32_t contact_count;                   /* of `contacts`, 0 to 16 */
  nade_joint joints[NADE_JOINT_COUNT];      /* to draw */
  float velocity_mps[NADE_JOINT_COUNT][3];  /* of the drawn joints; 0 in a hand's first frame */
  nade_contact contacts[NADE_MAX_CONTACTS]; /* at most one of each bone; the rest are 0 */
} nade_result;

/* A triangle mesh: metres, counter-clockwise seen from outside. */
typedef struct nade_mesh {
  uint32_t size;
  uint32_t vertex_count;
  uint32_t triangle_count;
  float scale[3];            /* along x, y and z, none 0, for the vertices; all 0: 1, 1, 1 */
  const float* vertices;     /* vertex_count times x y z */
  const uint32_t* triangles; /* triangle_count times three indices */
} nade_mesh;

/* What was found, and mended, in a mesh. */
typedef struct nade_mesh_report {
  uint32_t size;
  nade_solid solid;
  uint32_t triangles_used;
  uint32_t triangles_degenerate; /* without area; left out */
  uint32_t triangles_duplicate;  /* the same three corners again; left out */
  uint32_t triangles_turned;     /* wound against their neighbours; turned */
  uint32_t border_edges;         /* edges with one triangle */
  uint32_t nonmanifold_edges;    /* edges with more than two */
} nade_mesh_report;

/* The point of a surface nearest to a query. */
typedef struct nade_surface_point {
  double point[3];
  double normal[3];       /* out of the solid; given back by the library it is unit */
  double signed_distance; /* of the query: negative inside the solid */
} nade_surface_point;

/* Where a ray meets a surface. */
typedef struct nade_ray_hit {
  double point[3];
  double normal[3]; /* out of the solid, whichever side the ray came from */
  double distance;  /* along the ray */
} nade_ray_hit;

/* A surface of the program's own, in its own frame, metres. The functions are called inside
 * nade_corrector_update and nade_surface_closest_point, hundreds of times a frame, by each thread
 * that calls these; they must not throw. Answers that are not finite count as none. */
typedef struct nade_surface_callbacks {
  uint32_t size;
  uint32_t reserved; /* 0 */
  void* user;        /* passed to each of them */
  /* The nearest point of the surface that is no farther than `max_distance`, which may be
   * infinite: 1, or 0 where there is none. `hint` is UINT32_MAX or what an earlier query nearby
   * left there, below 2^24 - 1, for the callback's own use. */
  int32_t (*closest_point)(void* user, const double query[3], double max_distance, uint32_t* hint,
                           nade_surface_point* point);
  /* The first hit of a ray, from either side, no farther than `max_distance`; `direction` is unit.
   * NULL: found with `closest_point`, in up to 128 calls. */
  int32_t (*first_hit)(void* user, const double origin[3], const double direction[3],
                       double max_distance, nade_ray_hit* hit);
  /* Another number whenever the surface has another shape. NULL: it keeps its shape. */
  uint64_t (*shape)(void* user);
  /* A box that all of the surface is in, for scenes: 1, or 0 where there is none. NULL: none; a
   * scene then asks it in every frame. */
  int32_t (*bounds)(void* user, double low[3], double high[3]);
  /* The surface is freed: nothing is called after this. May be NULL. */
  void (*release)(void* user);
} nade_surface_callbacks;

typedef struct nade_group_member {
  const nade_surface* surface;
  nade_placement placement; /* in the group's frame */
} nade_group_member;

/* The skinned hand that a program draws, in its bind pose, metres. Skin of NADE_JOINT_PALM goes
 * with the middle metacarpal. */
typedef struct nade_hand_mesh {
  uint32_t size;
  nade_side side;
  uint32_t vertex_count;
  uint32_t triangle_count;
  const float* vertices;     /* vertex_count times x y z */
  const float* normals;      /* vertex_count times x y z, unit */
  const uint32_t* triangles; /* triangle_count times three indices, as of a nade_mesh */
  const uint8_t* bones;      /* vertex_count times four of NADE_JOINT_ */
  const float* weights;      /* vertex_count times four, 0 or more, of a sum above 0 */
  const nade_joint* bind;    /* NADE_JOINT_COUNT joints; frames as for tracked hands */
} nade_hand_mesh;

/* --- Library -------------------------------------------------------------------------------- */

/* NADE_ABI_VERSION of the library that runs; a program compares it with its own. */
NADE_API uint32_t nade_abi_version(void) NADE_NOEXCEPT;
/* The release, "0.1.0". Static. */
NADE_API const char* nade_version(void) NADE_NOEXCEPT;
/* 1 where the library has the capability, else 0, also for values that it does not know. */
NADE_API int32_t nade_has(nade_capability capability) NADE_NOEXCEPT;
/* What a code means, in a few words. Static; never NULL. */
NADE_API const char* nade_status_text(nade_status status) NADE_NOEXCEPT;
/* What a fault is: "a number of a joint is not finite". Static; never NULL. */
NADE_API const char* nade_fault_text(nade_fault fault) NADE_NOEXCEPT;
/* The sentence of the last call that failed on this thread, at most 255 bytes of UTF-8; "" where
 * none did. Never NULL; valid until the next call on this thread. */
NADE_API const char* nade_last_error(void) NADE_NOEXCEPT;
/* `callback` gets the sentence of each call that fails, on the thread that made it, before it
 * returns. It must not throw. NULL: none, as at first. Not while another thread calls nade. */
typedef void (*nade_message_callback)(void* user, nade_status status, const char* sentence);
NADE_API void nade_set_message_callback(nade_message_callback callback, void* user) NADE_NOEXCEPT;

/* --- Surfaces ------------------------------------------------------------------------------- */

/* Each makes a surface in its own frame and puts its handle into `surface`. They allocate; all but
 * hull, height field and mesh take microseconds. */

/* The half-space below y = 0. */
NADE_API nade_status nade_surface_create_plane(nade_surface** surface) NADE_NOEXCEPT;
/* A flat plate, as the planes of a room come: its top the part of the plane y = 0 within an
 * outline, solid for `thickness_m` > 0 below it. `outline_xz` has x and z of each of `count` >= 3
 * corners, in either order around, not crossing itself, of an area above 0. */
NADE_API nade_status nade_surface_create_plate(const float* outline_xz, size_t count,
                                               double thickness_m,
                                               nade_surface** surface) NADE_NOEXCEPT;
/* A ball about the origin. `radius_m` > 0. */
NADE_API nade_status nade_surface_create_sphere(double radius_m,
                                                nade_surface** surface) NADE_NOEXCEPT;
/* An ellipsoid about the origin: a ball that is scaled differently along its axes. All > 0. */
NADE_API nade_status nade_surface_create_ellipsoid(const double half_axes_m[3],
                                                   nade_surface** surface) NADE_NOEXCEPT;
/* A box about the origin. `half_size_m` > 0, with the rounding; `rounding_m` of its edges, from 0
 * to the smallest of it. */
NADE_API nade_status nade_surface_create_box(const double half_size_m[3], double rounding_m,
                                             nade_surface** surface) NADE_NOEXCEPT;
/* A cylinder about the Y axis, its middle in the origin. Both > 0; `rounding_m` of its rims, from 0
 * to the smaller. */
NADE_API nade_status nade_surface_create_cylinder(double half_height_m, double radius_m,
                                                  double rounding_m,
                                                  nade_surface** surface) NADE_NOEXCEPT;
/* What is within `radius_m` > 0 of a line of `length_m` >= 0 along Y, its middle in the origin. */
NADE_API nade_status nade_surface_create_capsule(double length_m, double radius_m,
                                                 nade_surface** surface) NADE_NOEXCEPT;
/* The smallest convex solid with all `count` >= 4 points in it; not all in a plane. Time grows as
 * the number of points times that of the faces. */
NADE_API nade_status nade_surface_create_hull(const float* points, size_t count,
                                              nade_surface** surface) NADE_NOEXCEPT;
/* Heights (Y), `rows` (+Z) of `columns` (+X), both >= 2, `step_m` > 0 apart, about the origin.
 * Solid below. */
NADE_API nade_status nade_surface_create_height_field(const float* heights, size_t columns,
                                                      size_t rows, double step_m,
                                                      nade_surface** surface) NADE_NOEXCEPT;
/* A triangle mesh, with its search tree: about a second for a million triangles. `report` may be
 * NULL. NADE_ERROR_DATA where no triangle has an area, a vertex is not finite, or an index is out
 * of range. */
NADE_API nade_status nade_surface_create_mesh(const nade_mesh* mesh, nade_mesh_report* report,
                                              nade_surface** surface) NADE_NOEXCEPT;
/* A surface of the program's own; the callbacks are copied. `closest_point` is needed. If this
 * fails, `release` is not called. */
NADE_API nade_status nade_surface_create_custom(const nade_surface_callbacks* callbacks,
                                                nade_surface** surface) NADE_NOEXCEPT;
/* Up to 255 surfaces as one, such as the parts of a thing; for more, or where several move, a scene
 * is faster. */
NADE_API nade_status nade_surface_create_group(const nade_group_member* members, size_t count,
                                               nade_surface** surface) NADE_NOEXCEPT;

/* New positions for the `vertex_count` vertices of a mesh, as it was created from them; its scale
 * is applied. All finite. Does not allocate; 0.02 ms for a thousand triangles. A scene that
 * has it is told by nade_scene_deformed. */
NADE_API nade_status nade_surface_refit(nade_surface* mesh, const float* vertices,
                                        size_t vertex_count) NADE_NOEXCEPT;
/* Moves member `index` of a group. Does not allocate. */
NADE_API nade_status nade_surface_place_member(nade_surface* group, size_t index,
                                               const nade_placement* placement) NADE_NOEXCEPT;
/* The point of a placed surface nearest to `query`, world coordinates. `found` is set to 0 where
 * there is none within `max_distance` >= 0, and `point` left as it is; else to 1. For programs that
 * want to know what a hand would feel. Does not allocate. */
NADE_API nade_status nade_surface_closest_point(const nade_surface* surface,
                                                const nade_placement* placement,
                                                const double query[3], double max_distance,
                                                nade_surface_point* point,
                                                int32_t* found) NADE_NOEXCEPT;
NADE_API nade_status nade_surface_destroy(nade_surface* surface) NADE_NOEXCEPT;

/* --- Scene ---------------------------------------------------------------------------------- */

/* All objects that a hand may touch, hundreds of them, by ids of the program's own. What is farther
 * than 0.3 m from a hand costs next to nothing and changes nothing; of more than 64 that are nearer
 * the nearest count. Where solids overlap they are one. */

NADE_API nade_status nade_scene_create(nade_scene** scene) NADE_NOEXCEPT;
/* One more object; several may share a surface. `placement` and `feel` may be NULL. One that comes
 * where a hand is pushes it out slowly. May allocate. NADE_ERROR_ID where the id is taken. */
NADE_API nade_status nade_scene_add(nade_scene* scene, uint64_t id, const nade_surface* surface,
                                    const nade_placement* placement,
                                    const nade_feel* feel) NADE_NOEXCEPT;
/* Moves, turns or scales an object, in any frame. Does not allocate. This and the next three:
 * NADE_ERROR_ID where there is none of that id. */
NADE_API nade_status nade_scene_place(nade_scene* scene, uint64_t id,
                                      const nade_placement* placement) NADE_NOEXCEPT;
/* The object's surface was refitted, or has other bounds. Does not allocate. */
NADE_API nade_status nade_scene_deformed(nade_scene* scene, uint64_t id) NADE_NOEXCEPT;
/* How it feels from the next frame on; NULL: the defaults. Does not allocate. */
NADE_API nade_status nade_scene_set_feel(nade_scene* scene, uint64_t id,
                                         const nade_feel* feel) NADE_NOEXCEPT;
/* A hand on it comes back slowly to where the person is. */
NADE_API nade_status nade_scene_remove(nade_scene* scene, uint64_t id) NADE_NOEXCEPT;
/* How many objects it has. */
NADE_API nade_status nade_scene_size(const nade_scene* scene, size_t* size) NADE_NOEXCEPT;
NADE_API nade_status nade_scene_destroy(nade_scene* scene) NADE_NOEXCEPT;

/* --- Hands ---------------------------------------------------------------------------------- */

/* The built-in hand at rest, of an adult's size: the palm joint in the origin, palm down, fingers
 * along -Z. Writes NADE_JOINT_COUNT joints; radii 0. For tests and first steps. */
NADE_API nade_status nade_rest_hand(nade_side side, nade_joint* joints) NADE_NOEXCEPT;
/* What can touch of a hand that a program draws itself: its skin, measured once. Takes a
 * fraction of a second. */
NADE_API nade_status nade_flesh_create(const nade_hand_mesh* mesh,
                                       nade_flesh** flesh) NADE_NOEXCEPT;
NADE_API nade_status nade_flesh_destroy(nade_flesh* flesh) NADE_NOEXCEPT;

/* --- Corrector ------------------------------------------------------------------------------ */

/* Fills in the defaults of what `size` covers. */
NADE_API nade_status nade_feel_init(nade_feel* feel) NADE_NOEXCEPT;
NADE_API nade_status nade_corrector_options_init(nade_corrector_options* options) NADE_NOEXCEPT;
/* Whether a corrector would take the options: the code and sentence that `create` would give. */
NADE_API nade_status nade_corrector_options_check(const nade_corrector_options* options)
    NADE_NOEXCEPT;

/* Corrects one hand, frame by frame: one for each hand. `options` may be NULL: the defaults. What
 * they point to is copied or kept. */
NADE_API nade_status nade_corrector_create(const nade_corrector_options* options,
                                           nade_corrector** corrector) NADE_NOEXCEPT;
/* The hand to draw for a tracked hand that may touch one surface. `joints` has NADE_JOINT_COUNT,
 * as tracked, never as drawn. `surface` is NULL in frames in which no object is near; a hand that
 * is not tracked is not passed at all. `placement` may be NULL. `object` is any number that tells
 * objects that share a surface apart. A hand that cannot be used is no error: it comes back as it
 * is, NADE_HAND_UNTRACKED, and `fault` says why. Asked again for the same time, hand and object it
 * gives the same answer and changes nothing. Time that goes back by more than 25 ms, or the other
 * hand, starts anew. `result` may not overlap `joints`. Keeps the surface until it gets another.
 * Does not allocate; 0.02 to 0.2 ms on a plane. */
NADE_API nade_status nade_corrector_update(nade_corrector* corrector, nade_side side,
                                           const nade_joint* joints, const nade_surface* surface,
                                           const nade_placement* placement, uint64_t object,
                                           int64_t time_ns, nade_result* result) NADE_NOEXCEPT;
/* The same for a hand that may touch any object of a scene, each with its own feel. The scene need
 * not be kept beyond the call. */
NADE_API nade_status nade_corrector_update_scene(nade_corrector* corrector, nade_side side,
                                                 const nade_joint* joints, const nade_scene* scene,
                                                 int64_t time_ns,
                                                 nade_result* result) NADE_NOEXCEPT;
/* The latest correction on a newer pose of the same hand, for a picture's late update: writes
 * NADE_JOINT_COUNT joints to `drawn`, which may be `joints`. Remembers nothing. `joints` as they
 * are where nothing was corrected, or they cannot be used. Does not allocate; microseconds. */
NADE_API nade_status nade_corrector_preview(const nade_corrector* corrector, nade_side side,
                                            const nade_joint* joints,
                                            nade_joint* drawn) NADE_NOEXCEPT;
/* How objects outside of a scene feel from the next frame on; NULL: the defaults. Does not
 * allocate. */
NADE_API nade_status nade_corrector_set_feel(nade_corrector* corrector,
                                             const nade_feel* feel) NADE_NOEXCEPT;
/* Forgets everything about the hand so far. */
NADE_API nade_status nade_corrector_reset(nade_corrector* corrector) NADE_NOEXCEPT;
NADE_API nade_status nade_corrector_destroy(nade_corrector* corrector) NADE_NOEXCEPT;

/* --- Skin ----------------------------------------------------------------------------------- */

/* The skin of a hand of NADE_METHOD_NADE is sunk where its flesh gives way, by up to 12 mm. An
 * opaque object hides that; of a thin or transparent one it comes out on the other side. For
 * drawing it is flattened. Each frame, of one hand:
 *
 *   nade_skin_pose(skin, result.joints, scale, vertices, normals, count);
 *   nade_skin_flatten(skin, result.joints, scale, surface, NULL, 0, vertices, normals, count);
 *   draw the vertices
 *
 * `scale` > 0 is the size of what is drawn over the mesh's own: of a mesh that is drawn as it is,
 * its bones merely put where the joints are, 1. `vertices` and `normals` have x, y and z of each of
 * `vertex_count`, which is the mesh's; world coordinates. `normals` may be NULL. NADE_ERROR_DATA
 * where the joints are no hand, see nade_fault. */

/* Measures a hand mesh, which is copied. One for each hand that is drawn. Takes a fraction of a
 * second. */
NADE_API nade_status nade_skin_create(const nade_hand_mesh* mesh, nade_skin** skin) NADE_NOEXCEPT;
/* Where the joints carry the mesh's vertices, each with up to four of them; for programs that have
 * no such vertices from their engine. Does not allocate. */
NADE_API nade_status nade_skin_pose(const nade_skin* skin, const nade_joint* joints, double scale,
                                    float* vertices, float* normals,
                                    size_t vertex_count) NADE_NOEXCEPT;
/* Moves posed vertices out of the surface where they are sunk, by as much as flesh gives way, and
 * turns their normals along; what is 2 mm above it or more stays bit for bit. `surface` and
 * `placement` may be NULL, as for nade_corrector_update. `give_m` >= 0: the object is drawn pressed
 * in by so much under the hand, and so much is left; 0 where it is drawn as it is. Keeps the
 * surface until it gets another. Does not allocate; takes about as long as a correction. */
NADE_API nade_status nade_skin_flatten(nade_skin* skin, const nade_joint* joints, double scale,
                                       const nade_surface* surface, const nade_placement* placement,
                                       double give_m, float* vertices, float* normals,
                                       size_t vertex_count) NADE_NOEXCEPT;
/* The same out of all objects of a scene. The scene need not be kept beyond the call. */
NADE_API nade_status nade_skin_flatten_scene(nade_skin* skin, const nade_joint* joints,
                                             double scale, const nade_scene* scene, double give_m,
                                             float* vertices, float* normals,
                                             size_t vertex_count) NADE_NOEXCEPT;
NADE_API nade_status nade_skin_destroy(nade_skin* skin) NADE_NOEXCEPT;

#ifdef __cplusplus
}
#endif

#endif
