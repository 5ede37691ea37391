/* nade_io.h as a program in C sees it: layouts, wrong arguments, files.
 *   c_io_test DATA FOLDER    reads tests/data; writes into FOLDER, stroke.jsonl.gz among it
 *   c_io_test --corrected FILE    whether that stroke was corrected on a plane */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "nade_io.h"

static int failures = 0;

static void check(int condition, const char* what, int line) {
  if (condition) return;
  printf("c_io_test.c:%d: %s (%s)\n", line, what, nade_io_last_error());
  ++failures;
}
#define CHECK(condition) check(condition, #condition, __LINE__)
#define CHECK_OK(call) CHECK((call) == NADE_OK)
#define CHECK_LAYOUT(type, field, offset, bytes) \
  CHECK(offsetof(type, field) == (offset) && sizeof(((type*)0)->field) == (bytes))
/* A call that fails with a code, and what its sentence has in it. */
#define CHECK_FAILS(call, code, part) \
  CHECK((call) == (code) && strstr(nade_io_last_error(), part) != NULL)

enum { STROKE_FRAMES = 91 };
static const char* data;
static const char* folder;

/* Of a folder's file; valid until the fourth next call. */
static const char* in(const char* where, const char* name) {
  static char paths[4][1024];
  static int next = 0;
  char* const path = paths[next++ % 4];
  snprintf(path, sizeof paths[0], "%s/%s", where, name);
  return path;
}

static nade_io_frame a_frame(int64_t time_ns) {
  nade_io_frame frame = {.size = sizeof frame};
  frame.time_ns = time_ns;
  frame.has = NADE_IO_HAS_RIGHT;
  for (int side = 0; side < 2; ++side) {
    for (int i = 0; i < NADE_JOINT_COUNT; ++i) {
      nade_joint* const joint = &frame.joints[side][i];
      joint->rotation[3] = 1;
      joint->position[0] = 0.02f * (float)(i % 5);
      joint->position[2] = -0.008f * (float)i;
      joint->radius = 0.008f;
    }
  }
  return frame;
}

static void check_layouts(void) {
  CHECK(sizeof(nade_io_frame) == 1728);
  CHECK_LAYOUT(nade_io_frame, size, 0, 4);
  CHECK_LAYOUT(nade_io_frame, has, 4, 4);
  CHECK_LAYOUT(nade_io_frame, time_ns, 8, 8);
  CHECK_LAYOUT(nade_io_frame, joints, 16, 1664);
  CHECK_LAYOUT(nade_io_frame, confidence, 1680, 8);
  CHECK_LAYOUT(nade_io_frame, status, 1688, 8);
  CHECK_LAYOUT(nade_io_frame, head_rotation, 1696, 16);
  CHECK_LAYOUT(nade_io_frame, head_position, 1712, 12);
  CHECK_LAYOUT(nade_io_frame, reserved, 1724, 4);
  if (sizeof(void*) != 8) return;
  CHECK(sizeof(nade_io_info) == 40);
  CHECK_LAYOUT(nade_io_info, size, 0, 4);
  CHECK_LAYOUT(nade_io_info, format, 4, 4);
  CHECK_LAYOUT(nade_io_info, hand_scale_known, 8, 4);
  CHECK_LAYOUT(nade_io_info, reserved, 12, 4);
  CHECK_LAYOUT(nade_io_info, source, 16, 8);
  CHECK_LAYOUT(nade_io_info, created, 24, 8);
  CHECK_LAYOUT(nade_io_info, more, 32, 8);
}

static void check_library(void) {
  CHECK(nade_io_abi_version() == NADE_IO_ABI_VERSION);
  CHECK(strchr(nade_io_version(), '.') != NULL);
  for (int i = 3; i > -110; --i) CHECK(strlen(nade_io_status_text(i)) > 0);
  CHECK(strcmp(nade_io_status_text(NADE_IO_ERROR_READ), nade_io_status_text(-99)) != 0);
  CHECK(strcmp(nade_io_last_error(), "") == 0);
}

static void check_wrong_reader_arguments(void) {
  const char* const file = in(data, "recording_v1.jsonl");
  nade_io_reader* reader = NULL;
  nade_io_frame frame = {.size = sizeof frame};
  nade_io_info info = {.size = sizeof info};
  int32_t found = 7;
  size_t count = 7;
  const char* sentence = NULL;
  CHECK_FAILS(nade_io_reader_open(NULL, &reader), NADE_ERROR_ARGUMENT, "path");
  CHECK_FAILS(nade_io_reader_open("", &reader), NADE_ERROR_ARGUMENT, "path");
  CHECK_FAILS(nade_io_reader_open(file, NULL), NADE_ERROR_ARGUMENT, "reader");
  CHECK_FAILS(nade_io_reader_open(in(data, "none.jsonl"), &reader), NADE_IO_ERROR_NOT_FOUND,
              "none.jsonl");
  CHECK_FAILS(nade_io_reader_open(data, &reader), NADE_IO_ERROR_READ, data);
  CHECK_FAILS(nade_io_reader_open(in(data, "simulated_study.R"), &reader), NADE_IO_ERROR_CONTENT,
              "simulated_study.R");
  CHECK(reader == NULL);

  CHECK_OK(nade_io_reader_open(file, &reader));
  CHECK_FAILS(nade_io_reader_next(NULL, &frame, &found), NADE_ERROR_HANDLE, "reader");
  CHECK_FAILS(nade_io_reader_next(reader, NULL, &found), NADE_ERROR_ARGUMENT, "frame");
  CHECK_FAILS(nade_io_reader_next(reader, &frame, NULL), NADE_ERROR_ARGUMENT, "found");
  frame.size = sizeof frame - 8;
  CHECK_FAILS(nade_io_reader_next(reader, &frame, &found), NADE_ERROR_SIZE, "nade_io_frame");
  info.size = 0;
  CHECK_FAILS(nade_io_reader_info(reader, &info), NADE_ERROR_SIZE, "nade_io_info");
  CHECK_FAILS(nade_io_reader_info(reader, NULL), NADE_ERROR_ARGUMENT, "info");
  CHECK_FAILS(nade_io_reader_warning_count(reader, NULL), NADE_ERROR_ARGUMENT, "count");
  CHECK_FAILS(nade_io_reader_warning(reader, 99, &sentence), NADE_ERROR_ARGUMENT, "index");
  CHECK_FAILS(nade_io_reader_warning(reader, 0, NULL), NADE_ERROR_ARGUMENT, "sentence");
  CHECK(found == 7 && count == 7 && sentence == NULL);

  CHECK_OK(nade_io_reader_destroy(reader));
  CHECK_OK(nade_io_reader_destroy(NULL));
  frame.size = sizeof frame;
  CHECK_FAILS(nade_io_reader_next(reader, &frame, &found), NADE_ERROR_HANDLE, "destroyed");
  CHECK_FAILS(nade_io_reader_destroy(reader), NADE_ERROR_HANDLE, "destroyed");
  CHECK_FAILS(nade_io_writer_finish((nade_io_writer*)reader), NADE_ERROR_HANDLE, "writer");
}

static void check_wrong_writer_arguments(void) {
  const char* const file = in(folder, "wrong.jsonl");
  nade_io_writer* writer = NULL;
  nade_io_info info = {.size = sizeof info};
  nade_io_frame frame = a_frame(1000);
  CHECK_FAILS(nade_io_writer_create(NULL, NULL, &writer), NADE_ERROR_ARGUMENT, "path");
  CHECK_FAILS(nade_io_writer_create(file, NULL, NULL), NADE_ERROR_ARGUMENT, "writer");
  CHECK_FAILS(nade_io_writer_create(folder, NULL, &writer), NADE_IO_ERROR_WRITE, folder);
  CHECK_FAILS(nade_io_writer_create(in(folder, "none/a.jsonl"), NULL, &writer), NADE_IO_ERROR_WRITE,
              "a.jsonl");
  info.more = "[1]";
  CHECK_FAILS(nade_io_writer_create(file, &info, &writer), NADE_ERROR_ARGUMENT, "info: more");
  info.more = NULL;
  info.hand_scale_known = 2;
  CHECK_FAILS(nade_io_writer_create(file, &info, &writer), NADE_ERROR_ARGUMENT, "hand_scale");
  info.size = 3;
  CHECK_FAILS(nade_io_writer_create(file, &info, &writer), NADE_ERROR_SIZE, "nade_io_info");
  CHECK(writer == NULL);

  CHECK_OK(nade_io_writer_create(file, NULL, &writer));
  CHECK_FAILS(nade_io_writer_write(writer, NULL), NADE_ERROR_ARGUMENT, "frame");
  CHECK_FAILS(nade_io_writer_write(NULL, &frame), NADE_ERROR_HANDLE, "writer");
  frame.size = 12;
  CHECK_FAILS(nade_io_writer_write(writer, &frame), NADE_ERROR_SIZE, "nade_io_frame");
  frame = a_frame(1000);
  frame.has = 32;
  CHECK_FAILS(nade_io_writer_write(writer, &frame), NADE_ERROR_ARGUMENT, "has");
  frame = a_frame(1000);
  frame.joints[NADE_RIGHT][3].position[1] = NAN;
  CHECK_FAILS(nade_io_writer_write(writer, &frame), NADE_ERROR_ARGUMENT, "right");
  frame = a_frame(1000);
  frame.has |= NADE_IO_HAS_STATUS;
  frame.status[NADE_RIGHT] = 9;
  CHECK_FAILS(nade_io_writer_write(writer, &frame), NADE_ERROR_ARGUMENT, "status");
  frame = a_frame(1000);
  frame.has |= NADE_IO_HAS_CONFIDENCE;
  frame.confidence[NADE_RIGHT] = NAN;
  CHECK_FAILS(nade_io_writer_write(writer, &frame), NADE_ERROR_ARGUMENT, "right");
  frame = a_frame(1000);
  frame.has |= NADE_IO_HAS_HEAD; /* whose rotation is 0 */
  CHECK_FAILS(nade_io_writer_write(writer, &frame), NADE_ERROR_ARGUMENT, "head_rotation");
  frame = a_frame(INT64_MAX);
  CHECK_FAILS(nade_io_writer_write(writer, &frame), NADE_ERROR_ARGUMENT, "time");
  /* None of these harmed it. */
  frame = a_frame(1000);
  CHECK_OK(nade_io_writer_write(writer, &frame));
  CHECK_FAILS(nade_io_writer_write(writer, &frame), NADE_ERROR_ARGUMENT, "after 1000 ns");
  CHECK_OK(nade_io_writer_finish(writer));
  CHECK_FAILS(nade_io_writer_finish(writer), NADE_ERROR_HANDLE, "finished");
  frame.time_ns = 2000;
  CHECK_FAILS(nade_io_writer_write(writer, &frame), NADE_ERROR_HANDLE, "finished");
  CHECK_OK(nade_io_writer_destroy(writer));
  CHECK_FAILS(nade_io_writer_write(writer, &frame), NADE_ERROR_HANDLE, "destroyed");
}

/* How many frames and hands a file of tests/data has, and what it is. */
static void check_file(const char* name, nade_io_format format, int frames, int hands) {
  nade_io_reader* reader = NULL;
  nade_io_info info = {.size = sizeof info};
  nade_io_frame frame = {.size = sizeof frame};
  int32_t found = 1;
  int seen = 0;
  int seen_hands = 0;
  int64_t before = INT64_MIN;
  CHECK_OK(nade_io_reader_open(in(data, name), &reader));
  CHECK_OK(nade_io_reader_info(reader, &info));
  CHECK(info.format == format);
  CHECK(info.source != NULL && info.created != NULL && info.more != NULL);
  while (1) {
    CHECK_OK(nade_io_reader_next(reader, &frame, &found));
    if (!found || failures > 0) break;
    CHECK(frame.time_ns > before);
    before = frame.time_ns;
    ++seen;
    for (int side = 0; side < 2; ++side) {
      const int tracked = (frame.has >> side) & 1;
      seen_hands += tracked;
      const float* const turn = frame.joints[side][NADE_JOINT_WRIST].rotation;
      const float length =
          turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2] + turn[3] * turn[3];
      CHECK(fabsf(length - (float)tracked) < 1e-3f);
    }
  }
  CHECK(seen == frames);
  CHECK(seen_hands == hands);
  if (seen != frames || seen_hands != hands) printf("%s: %d, %d\n", name, seen, seen_hands);
  CHECK_OK(nade_io_reader_destroy(reader));
}

/* What is written comes back. */
static void check_round_trip(const char* name) {
  nade_io_reader* reader = NULL;
  nade_io_writer* writer = NULL;
  nade_io_info info = {.size = sizeof info};
  nade_io_frame first = a_frame(-5000000);
  nade_io_frame second = a_frame(10000000);
  nade_io_frame read = {.size = sizeof read};
  int32_t found = 0;
  size_t warnings = 7;
  const char* warning = NULL;
  info.hand_scale_known = 1;
  info.source = "c";
  info.more = "{\"place\":\"here\"}";
  first.has = NADE_IO_HAS_LEFT | NADE_IO_HAS_CONFIDENCE | NADE_IO_HAS_STATUS | NADE_IO_HAS_HEAD;
  first.confidence[NADE_LEFT] = 0.5f;
  first.status[NADE_LEFT] = NADE_HAND_RELEASED;
  first.head_rotation[3] = 1;
  first.head_position[1] = 1.5f;
  second.has = 0;
  CHECK_OK(nade_io_writer_create(in(folder, name), &info, &writer));
  CHECK_OK(nade_io_writer_write(writer, &first));
  CHECK_OK(nade_io_writer_write(writer, &second));
  CHECK_OK(nade_io_writer_finish(writer));
  CHECK_OK(nade_io_writer_destroy(writer));

  memset(&info, 0, sizeof info);
  info.size = sizeof info;
  CHECK_OK(nade_io_reader_open(in(folder, name), &reader));
  CHECK_OK(nade_io_reader_info(reader, &info));
  CHECK(info.format == NADE_IO_FORMAT_NADE && info.hand_scale_known == 1);
  CHECK(strcmp(info.source, "c") == 0 && strcmp(info.created, "") == 0);
  CHECK(strcmp(info.more, "{\"place\":\"here\"}") == 0);
  CHECK_OK(nade_io_reader_next(reader, &read, &found));
  /* The right hand was not there. */
  memset(first.joints[NADE_RIGHT], 0, sizeof first.joints[NADE_RIGHT]);
  CHECK(found == 1 && memcmp(&read, &first, sizeof read) == 0);
  CHECK_OK(nade_io_reader_next(reader, &read, &found));
  CHECK(found == 1 && read.has == 0 && read.time_ns == second.time_ns);
  CHECK_OK(nade_io_reader_next(reader, &read, &found));
  CHECK(found == 0 && read.time_ns == second.time_ns);
  CHECK_OK(nade_io_reader_warning_count(reader, &warnings));
  CHECK(warnings == 1); /* a_frame's joints are no device's */
  CHECK_OK(nade_io_reader_warning(reader, 0, &warning));
  CHECK(strstr(warning, "all joints are turned alike") != NULL);
  CHECK_OK(nade_io_reader_destroy(reader));
}

static void check_unfinished(void) {
  nade_io_reader* reader = NULL;
  nade_io_writer* writer = NULL;
  const nade_io_frame frame = a_frame(0);
  CHECK_OK(nade_io_writer_create(in(folder, "unfinished.jsonl"), NULL, &writer));
  CHECK_OK(nade_io_writer_write(writer, &frame));
  CHECK_OK(nade_io_writer_destroy(writer));
  CHECK_FAILS(nade_io_reader_open(in(folder, "unfinished.jsonl"), &reader), NADE_IO_ERROR_NOT_FOUND,
              "unfinished.jsonl");
}

/* A file that is wrong in its third line, and one that is cut off there. */
static void check_broken(void) {
  nade_io_reader* reader = NULL;
  nade_io_frame frame = {.size = sizeof frame};
  const char* sentence = NULL;
  int32_t found = 0;
  const char* const lines =
      "{\"format\":\"nade-recording\",\"version\":1,\"source\":\"c\"}\n{\"t\":0}\n{\"t\":";
  FILE* file = fopen(in(folder, "broken.jsonl"), "wb");
  fprintf(file, "%s\"soon\"}\n", lines);
  fclose(file);
  file = fopen(in(folder, "cut.jsonl"), "wb");
  fprintf(file, "%s", lines);
  fclose(file);

  CHECK_OK(nade_io_reader_open(in(folder, "broken.jsonl"), &reader));
  CHECK_OK(nade_io_reader_next(reader, &frame, &found));
  CHECK(found == 1);
  for (int i = 0; i < 2; ++i) {
    CHECK_FAILS(nade_io_reader_next(reader, &frame, &found), NADE_IO_ERROR_CONTENT,
                "broken.jsonl: line 3");
  }
  CHECK(found == 1);
  CHECK_OK(nade_io_reader_destroy(reader));

  CHECK_OK(nade_io_reader_open(in(folder, "cut.jsonl"), &reader));
  CHECK_OK(nade_io_reader_next(reader, &frame, &found));
  CHECK_OK(nade_io_reader_next(reader, &frame, &found));
  CHECK(found == 0);
  CHECK_OK(nade_io_reader_warning(reader, 0, &sentence));
  CHECK(strstr(sentence, "line 3") != NULL);
  CHECK_OK(nade_io_reader_destroy(reader));
}

/* More than a sentence of nade.h has room for. */
static void check_long_path(void) {
  char path[700];
  nade_io_reader* reader = NULL;
  memset(path, 'x', sizeof path);
  for (int i = 50; i < 650; i += 50) path[i] = '/';
  strcpy(path + sizeof path - 12, "/none.jsonl");
  CHECK_FAILS(nade_io_reader_open(path, &reader), NADE_IO_ERROR_NOT_FOUND, "no such file");
}

/* A second in which the right hand sinks 30 mm into the plane, for examples/correct_file.c. */
static void write_stroke(void) {
  nade_io_writer* writer = NULL;
  CHECK_OK(nade_io_writer_create(in(folder, "stroke.jsonl.gz"), NULL, &writer));
  for (int k = 0; k < STROKE_FRAMES; ++k) {
    nade_io_frame frame = a_frame(k * INT64_C(11111111));
    for (int i = 0; i < NADE_JOINT_COUNT; ++i) {
      frame.joints[NADE_RIGHT][i].position[1] += 0.07f - 0.1f * (float)k / (STROKE_FRAMES - 1);
    }
    CHECK_OK(nade_io_writer_write(writer, &frame));
  }
  CHECK_OK(nade_io_writer_finish(writer));
  CHECK_OK(nade_io_writer_destroy(writer));
}

static void check_corrected(const char* path) {
  nade_io_reader* reader = NULL;
  nade_io_frame frame = {.size = sizeof frame};
  int32_t found = 1;
  int frames = 0;
  CHECK_OK(nade_io_reader_open(path, &reader));
  while (1) {
    CHECK_OK(nade_io_reader_next(reader, &frame, &found));
    if (!found || failures > 0) break;
    ++frames;
  }
  CHECK(frames == STROKE_FRAMES);
  CHECK((frame.has & NADE_IO_HAS_STATUS) != 0);
  CHECK(frame.status[NADE_RIGHT] == NADE_HAND_CORRECTED);
  CHECK(frame.joints[NADE_RIGHT][NADE_JOINT_PALM].position[1] > 0);
  CHECK_OK(nade_io_reader_destroy(reader));
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  if (strcmp(argv[1], "--corrected") == 0) {
    check_corrected(argv[2]);
    return failures == 0 ? 0 : 1;
  }
  data = argv[1];
  folder = argv[2];
  check_layouts();
  check_library();
  check_wrong_reader_arguments();
  check_wrong_writer_arguments();
  check_file("recording_v1.jsonl", NADE_IO_FORMAT_NADE, 4, 4);
  check_file("leap_v2.json", NADE_IO_FORMAT_LEAP_V2, 4, 4);
  check_file("webxr_actions.json", NADE_IO_FORMAT_WEBXR_ACTIONS, 6, 11);
  check_file("mediapipe_results.json", NADE_IO_FORMAT_MEDIAPIPE_HANDS, 4, 6);
  check_file("webxr_joints.json", NADE_IO_FORMAT_WEBXR_JOINTS, 3, 5);
  check_file("hands.bvh", NADE_IO_FORMAT_BVH, 4, 8);
  check_round_trip("both.jsonl");
  check_round_trip("both.jsonl.gz");
  check_unfinished();
  check_broken();
  check_long_path();
  write_stroke();
  return failures == 0 ? 0 : 1;
}
