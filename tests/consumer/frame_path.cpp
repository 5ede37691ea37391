#include <cstdio>
#include <limits>

#include "nade/corrector.h"
#include "nade/surface.h"

int main() {
  const nade::SphereSurface ball(0.1);
  const nade::Object object(ball);
  nade::SurfaceHint hint;
  const auto nearest = object.closest_point({0.0, 0.15, 0.0}, 1.0, hint);
  if (!nearest) return 1;
  nade::HandCorrector corrector;
  nade::HandPose lost;
  lost[nade::Joint::wrist].position.x() = std::numeric_limits<double>::quiet_NaN();
  if (corrector.update(lost, object, 0).status != nade::HandStatus::untracked) return 1;
  std::printf("%.3f m above the ball\n", nearest->signed_distance);
  return nearest->signed_distance > 0.0499 && nearest->signed_distance < 0.0501 ? 0 : 1;
}
