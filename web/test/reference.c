/* Corrects the hands of a file with the C library of this machine: reference IN OUT.
 *
 * IN: cases, each of uint32 method, kind (0 plane, 1 ball, 2 mesh), vertices, triangles, frames;
 * the vertices (three floats) and triangles (three uint32); and the frames: int64 time, int32 side,
 * int32 0, the joints. OUT: for each case the joints of all frames, then as a double the median
 * nanoseconds of an update. All of this machine's byte order. */
#define _POSIX_C_SOURCE 199309L
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "nade.h"

struct frame {
  int64_t time_ns;
  int32_t side;
  int32_t reserved;
  nade_joint joints[NADE_JOINT_COUNT];
};

static void stop(const char* sentence) {
  fprintf(stderr, "reference: %s\n", sentence);
  exit(1);
}

static void must(nade_status status) {
  if (status != NADE_OK) stop(nade_last_error());
}

static void* read_all(FILE* in, size_t size, size_t count) {
  void* const data = malloc(size * count + 1);
  if (data == NULL || fread(data, size, count, in) != count) stop("IN: is cut off");
  return data;
}

static int by_value(const void* a, const void* b) {
  const double x = *(const double*)a;
  const double y = *(const double*)b;
  return (x > y) - (x < y);
}

static double now_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return 1e9 * (double)now.tv_sec + (double)now.tv_nsec;
}

static nade_surface* read_surface(FILE* in, const uint32_t* head) {
  nade_surface* surface = NULL;
  float* const vertices = read_all(in, 12, head[2]);
  uint32_t* const triangles = read_all(in, 12, head[3]);
  nade_mesh mesh = {sizeof mesh, head[2], head[3], {0, 0, 0}, vertices, triangles};
  if (head[1] == 0) must(nade_surface_create_plane(&surface));
  if (head[1] == 1) must(nade_surface_create_sphere(0.1, &surface));
  if (head[1] == 2) must(nade_surface_create_mesh(&mesh, NULL, &surface));
  free(vertices);
  free(triangles);
  return surface;
}

int main(int count, char** arguments) {
  uint32_t head[5];
  FILE* const in = count == 3 ? fopen(arguments[1], "rb") : NULL;
  FILE* const out = count == 3 ? fopen(arguments[2], "wb") : NULL;
  if (in == NULL || out == NULL) stop("expected IN and OUT");
  while (fread(head, sizeof head, 1, in) == 1) {
    const uint32_t frames = head[4];
    nade_surface* const surface = read_surface(in, head);
    struct frame* const frame = read_all(in, sizeof *frame, frames);
    double* const times = malloc(frames * sizeof *times + 1);
    if (times == NULL) stop("no memory is left");
    nade_corrector* corrector[2] = {NULL, NULL};
    nade_corrector_options options = {.size = sizeof options};
    must(nade_corrector_options_init(&options));
    options.method = (nade_method)head[0];
    for (int side = 0; side < 2; ++side) must(nade_corrector_create(&options, &corrector[side]));
    for (uint32_t i = 0; i < frames; ++i) {
      nade_result result = {.size = sizeof result};
      const double start = now_ns();
      must(nade_corrector_update(corrector[frame[i].side], frame[i].side, frame[i].joints, surface,
                                 NULL, 0, frame[i].time_ns, &result));
      times[i] = now_ns() - start;
      fwrite(result.joints, sizeof result.joints, 1, out);
    }
    qsort(times, frames, sizeof *times, by_value);
    fwrite(&times[frames / 2], sizeof *times, 1, out);
    free(frame);
    free(times);
  }
  return fclose(out) == 0 ? 0 : 1;
}
