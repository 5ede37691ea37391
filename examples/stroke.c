/* nade from C: a hand is pressed 30 mm into a ball, and drawn on it. */
#include <stdio.h>

#include "nade.h"

static int check(nade_status status) {
  if (status != NADE_OK) fprintf(stderr, "%s\n", nade_last_error());
  return status == NADE_OK;
}

int main(void) {
  const int32_t shown[] = {NADE_JOINT_PALM, NADE_JOINT_INDEX_TIP, NADE_JOINT_LITTLE_TIP};
  const nade_placement below = {{0, 0, 0, 1}, {0, -0.15f, 0}, 1}; /* the ball's top is y = 0 */
  nade_corrector* corrector = NULL;                               /* one for each hand */
  nade_surface* ball = NULL;
  nade_joint rest[NADE_JOINT_COUNT], tracked[NADE_JOINT_COUNT];
  nade_result drawn = {.size = sizeof drawn};

  if (!check(nade_corrector_create(NULL, &corrector))) return 1;
  if (!check(nade_surface_create_sphere(0.15, &ball))) return 1;
  if (!check(nade_rest_hand(NADE_RIGHT, rest))) return 1;
  for (int frame = 0; frame <= 90; ++frame) { /* a second; a tracker would give the joints */
    for (int i = 0; i < NADE_JOINT_COUNT; ++i) {
      tracked[i] = rest[i];
      tracked[i].position[1] += 0.07f - 0.1f * (float)frame / 90;
    }
    if (!check(nade_corrector_update(corrector, NADE_RIGHT, tracked, ball, &below, 0,
                                     frame * INT64_C(11111111), &drawn))) {
      return 1;
    }
  }
  for (int k = 0; k < 3; ++k) {
    printf("joint %2d: tracked at %6.1f mm, drawn at %6.1f mm\n", shown[k],
           1e3 * tracked[shown[k]].position[1], 1e3 * drawn.joints[shown[k]].position[1]);
  }
  nade_surface_destroy(ball);
  nade_corrector_destroy(corrector);
  return drawn.status == NADE_HAND_CORRECTED ? 0 : 1;
}
