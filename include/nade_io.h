/* Recordings of tracked hands in C: read, and written. C99 or C++; beside nade.h, whose joints,
 * sides and codes it uses, and by itself.
 *
 *   nade_io_reader* reader = NULL;
 *   nade_io_frame frame = {.size = sizeof frame};
 *   int32_t found = 0;
 *   if (nade_io_reader_open("stroke.jsonl.gz", &reader) != NADE_OK) puts(nade_io_last_error());
 *   while (nade_io_reader_next(reader, &frame, &found) == NADE_OK && found) {
 *     if (frame.has & NADE_IO_HAS_RIGHT) use(frame.joints[NADE_RIGHT], frame.time_ns);
 *   }
 *   nade_io_reader_destroy(reader);
 *
 * Units and frames are those of nade.h: metres, nanoseconds, right-handed, +Y up; 26 joints in the
 * order of XrHandJointEXT. Numbers are doubles in files and floats here.
 *
 * Files. Paths are in UTF-8; "-" is standard input or output. What is read is told from its
 * content: nade's own recordings and all others that docs/formats.md names; plain or gzip. What is
 * written goes by the name's ending: .csv, .mcap and .glb as docs/formats.md has them, nade's own
 * recording with every other; gzip where it ends in .gz.
 *
 * Errors. Every function that can fail returns a nade_status: NADE_OK, or a negative code of nade.h
 * or of those below; nade_io_last_error() has the sentence, which names the argument, or the file
 * and the place in it. A call that failed writes nothing to its arguments. Nothing is thrown or
 * printed, and the program is not stopped.
 *
 * Handles, structs, memory, threads and stability are as nade.h says: a handle that was destroyed
 * is told, structs that begin with `size` may grow, any thread may call, a handle is used by one at
 * a time. Everything here may allocate, and wait for the disk; it is not for a frame that is drawn.
 */
#ifndef NADE_IO_H
#define NADE_IO_H

#include "nade.h"

#define NADE_IO_ABI_VERSION 1

#if defined(_WIN32) && defined(NADE_IO_BUILDS)
#define NADE_IO_API __declspec(dllexport)
#elif defined(_WIN32)
#define NADE_IO_API __declspec(dllimport)
#elif defined(__GNUC__)
#define NADE_IO_API __attribute__((visibility("default")))
#else
#define NADE_IO_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* --- Codes ---------------------------------------------------------------------------------- */

/* More of nade_status. */
enum {
  NADE_IO_ERROR_NOT_FOUND = -101, /* no such file */
  NADE_IO_ERROR_READ = -102,      /* the file is there and cannot be read */
  NADE_IO_ERROR_WRITE = -103,     /* the output cannot be written whole */
  NADE_IO_ERROR_CONTENT = -104    /* no recording, or something in it cannot be used */
};

/* What a file is; values may be added. */
typedef int32_t nade_io_format;
enum {
  NADE_IO_FORMAT_NADE = 0,            /* nade's own: JSON Lines */
  NADE_IO_FORMAT_LEAP_V2 = 1,         /* Leap Motion, frames of LeapJS */
  NADE_IO_FORMAT_WEBXR_ACTIONS = 2,   /* action recording of a WebXR session (IWER) */
  NADE_IO_FORMAT_JOINT_TABLE = 3,     /* CSV */
  NADE_IO_FORMAT_MEDIAPIPE_HANDS = 4, /* results of MediaPipe's hand tracking */
  NADE_IO_FORMAT_WEBXR_JOINTS = 5,    /* joints that a WebXR page writes down */
  NADE_IO_FORMAT_BVH = 6,             /* motion capture */
  NADE_IO_FORMAT_HOT3D = 7,           /* hand trajectories of that data set */
  NADE_IO_FORMAT_UNITY_HANDS = 8      /* of Unity's XR Hand Capture */
};

/* What a frame has, added up. */
enum {
  NADE_IO_HAS_LEFT = 1,   /* the left hand was tracked: 1 << NADE_LEFT */
  NADE_IO_HAS_RIGHT = 2,  /* the right one: 1 << NADE_RIGHT */
  NADE_IO_HAS_HEAD = 4,   /* the viewer's head */
  NADE_IO_HAS_STATUS = 8, /* `status`, as of a corrected recording, of each hand that is there */
  NADE_IO_HAS_CONFIDENCE = 16 /* `confidence`; without it 1 is written */
};

/* --- Structs -------------------------------------------------------------------------------- */

typedef struct nade_io_reader nade_io_reader;
typedef struct nade_io_writer nade_io_writer;

/* What a recording says of itself. */
typedef struct nade_io_info {
  uint32_t size;
  nade_io_format format;    /* of what was read; of no meaning when written */
  int32_t hand_scale_known; /* 1 where the hands have the person's own size, else 0 */
  uint32_t reserved;        /* 0 */
  const char* source;       /* where the hands came from: "leap", "webxr"; "" or NULL: unknown */
  const char* created;      /* ISO 8601, UTC; "" or NULL: unknown */
  const char* more;         /* other keys, as a JSON object; "" or NULL: none */
} nade_io_info;

typedef struct nade_io_frame {
  uint32_t size;
  uint32_t has;                           /* of NADE_IO_HAS_ */
  int64_t time_ns;                        /* of the source's own clock; up to 4e18 from 0 */
  nade_joint joints[2][NADE_JOINT_COUNT]; /* by NADE_LEFT, NADE_RIGHT */
  float confidence[2];                    /* the tracker's own, 0 to 1 */
  nade_hand_status status[2];             /* of corrected hands */
  float head_rotation[4];                 /* x y z w */
  float head_position[3];                 /* midway between the eyes */
  uint32_t reserved;                      /* 0 */
} nade_io_frame;

/* --- Library -------------------------------------------------------------------------------- */

/* NADE_IO_ABI_VERSION of the library that runs; a program compares it with its own. */
NADE_IO_API uint32_t nade_io_abi_version(void) NADE_NOEXCEPT;
/* The release, "0.1.0". Static. */
NADE_IO_API const char* nade_io_version(void) NADE_NOEXCEPT;
/* What a code of either header means, in a few words. Static; never NULL. */
NADE_IO_API const char* nade_io_status_text(nade_status status) NADE_NOEXCEPT;
/* The sentence of the last call of this header that failed on this thread, at most 4095 bytes of
 * UTF-8; "" where none did. Never NULL; valid until the next call on this thread. */
NADE_IO_API const char* nade_io_last_error(void) NADE_NOEXCEPT;

/* --- Reading -------------------------------------------------------------------------------- */

/* Opens a recording and reads its beginning. */
NADE_IO_API nade_status nade_io_reader_open(const char* path,
                                            nade_io_reader** reader) NADE_NOEXCEPT;
/* What it says of itself. The texts stay until the reader is destroyed. */
NADE_IO_API nade_status nade_io_reader_info(const nade_io_reader* reader,
                                            nade_io_info* info) NADE_NOEXCEPT;
/* The next frame. `found` is set to 1, or to 0 at the end, where `frame` stays as it is. Times
 * increase strictly; a hand that could not be used is left out of its frame, with a warning. What
 * is not there is 0. After a failure each further call fails alike. 0.1 ms; memory does not grow
 * with the file. */
NADE_IO_API nade_status nade_io_reader_next(nade_io_reader* reader, nade_io_frame* frame,
                                            int32_t* found) NADE_NOEXCEPT;
/* What was odd but not fatal so far, such as a last line that is cut off: how many sentences, and
 * each of them. A sentence is valid until the next call with this reader. */
NADE_IO_API nade_status nade_io_reader_warning_count(const nade_io_reader* reader,
                                                     size_t* count) NADE_NOEXCEPT;
NADE_IO_API nade_status nade_io_reader_warning(nade_io_reader* reader, size_t index,
                                               const char** sentence) NADE_NOEXCEPT;
NADE_IO_API nade_status nade_io_reader_destroy(nade_io_reader* reader) NADE_NOEXCEPT;

/* --- Writing -------------------------------------------------------------------------------- */

/* Begins a recording. `info` may be NULL. The file has its name, whole, only when it is finished;
 * what had that name before stays until then. */
NADE_IO_API nade_status nade_io_writer_create(const char* path, const nade_io_info* info,
                                              nade_io_writer** writer) NADE_NOEXCEPT;
/* One more frame: later than the one before, its hands without a nade_fault. Without
 * a hand it is a frame in which nothing was tracked. A frame that is refused
 * (NADE_ERROR_ARGUMENT) leaves the recording as it was. */
NADE_IO_API nade_status nade_io_writer_write(nade_io_writer* writer,
                                             const nade_io_frame* frame) NADE_NOEXCEPT;
/* The file is on the disk, and has its name. Nothing more can be written, whether this succeeded or
 * not; the handle is still to be destroyed. */
NADE_IO_API nade_status nade_io_writer_finish(nade_io_writer* writer) NADE_NOEXCEPT;
/* Without `finish` before it nothing is left of the recording. */
NADE_IO_API nade_status nade_io_writer_destroy(nade_io_writer* writer) NADE_NOEXCEPT;

#ifdef __cplusplus
}
#endif

#endif
