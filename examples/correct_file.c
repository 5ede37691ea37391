/* nade from C: corrects both hands of a recording against a table: correct_file IN OUT */
#include <stdio.h>

#include "nade.h"
#include "nade_io.h"

/* Each library has its own last sentence, "" where none of its calls failed. */
#define NADE_TRY(call)   \
  if ((call) != NADE_OK) \
  return fprintf(stderr, "%s%s\n", nade_last_error(), nade_io_last_error()), 1

int main(int argc, char** argv) {
  nade_corrector* correctors[2] = {NULL, NULL}; /* by NADE_LEFT, NADE_RIGHT */
  nade_surface* table = NULL;
  nade_io_reader* reader = NULL;
  nade_io_writer* writer = NULL;
  nade_io_info info = {.size = sizeof info};
  nade_io_frame frame = {.size = sizeof frame};
  nade_result hand = {.size = sizeof hand};
  int32_t found = 1;
  if (argc != 3) return fprintf(stderr, "usage: correct_file IN OUT\n"), 2;
  NADE_TRY(nade_surface_create_plane(&table));
  for (int side = 0; side < 2; ++side) NADE_TRY(nade_corrector_create(NULL, &correctors[side]));
  NADE_TRY(nade_io_reader_open(argv[1], &reader));
  NADE_TRY(nade_io_reader_info(reader, &info));
  NADE_TRY(nade_io_writer_create(argv[2], &info, &writer));
  while (1) {
    NADE_TRY(nade_io_reader_next(reader, &frame, &found));
    if (!found) break;
    for (int side = 0; side < 2; ++side) {
      if (!(frame.has & (1U << side))) continue;
      NADE_TRY(nade_corrector_update(correctors[side], side, frame.joints[side], table, NULL, 0,
                                     frame.time_ns, &hand));
      for (int i = 0; i < NADE_JOINT_COUNT; ++i) frame.joints[side][i] = hand.joints[i];
      frame.status[side] = hand.status;
      frame.has |= NADE_IO_HAS_STATUS;
    }
    NADE_TRY(nade_io_writer_write(writer, &frame));
  }
  NADE_TRY(nade_io_writer_finish(writer)); /* without it there is no file */
  return 0;
}
