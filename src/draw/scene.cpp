#include "nade/draw/scene.h"

#include <cmath>

namespace nade::draw {

FieldOfView symmetric_view(double vertical_rad, double aspect) {
  const double half = 0.5 * vertical_rad;
  const double side = std::atan(aspect * std::tan(half));
  return {-side, side, half, -half};
}

}  // namespace nade::draw
