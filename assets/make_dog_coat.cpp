#include <algorithm>
#include <cmath>

#include "make_dog_body.h"

namespace dog {
namespace {

const Vec3 kGold{0.80, 0.58, 0.34};
const Vec3 kSaddle{0.66, 0.43, 0.22};
const Vec3 kCream{0.95, 0.87, 0.74};
const Vec3 kEar{0.50, 0.29, 0.14};
const Vec3 kNose{0.09, 0.075, 0.075};
const Vec3 kMouth{0.20, 0.12, 0.10};
const Vec3 kPupil{0.03, 0.022, 0.02};
const Vec3 kIris{0.27, 0.13, 0.05};
const Vec3 kGlint{0.97, 0.97, 0.97};

double ramp(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

void mix(Vec3& color, const Vec3& other, double share) { color += share * (other - color); }

/// How much a point belongs to a part: 1 on its own surface, 0 beyond `reach` from it.
double belongs(const Body& body, const std::string& part, const Vec3& point, double reach) {
  const Part& p = body.part(part);
  if (p.bounds.exteriorDistance(point) > reach) return 0.0;
  return 1.0 - ramp(0.0, reach, p.distance(point));
}

void paint_eye(const Body& body, const std::string& side, const Vec3& point, Vec3& color) {
  const Part& eye = body.part(side + " eye");
  const double away = eye.distance(point);
  if (eye.bounds.exteriorDistance(point) > 0.01) return;
  mix(color, kPupil, 1.0 - ramp(0.0008, 0.0046, away));  // dark lids
  if (away > 0.0008) return;
  const auto& ball = std::get<Ellipsoid>(eye.shapes.front().form);
  const double sign = side == "left" ? 1.0 : -1.0;
  const Vec3 look = Vec3(-0.86, 0.10, 0.50 * sign).normalized();
  const Vec3 ray = (point - ball.center).normalized();
  const double turn = std::acos(std::clamp(ray.dot(look), -1.0, 1.0));
  mix(color, kIris, ramp(0.40, 0.50, turn) * (1.0 - ramp(0.72, 0.85, turn)));
  const Vec3 light = Vec3(-0.80, 0.46, 0.42 * sign).normalized();
  const double glint = std::acos(std::clamp(ray.dot(light), -1.0, 1.0));
  mix(color, kGlint, 1.0 - ramp(0.13, 0.23, glint));
}

}  // namespace

Vec3 coat_color(const Body& body, const Vec3& point) {
  Vec3 color = kGold;
  const Vec3 normal = body.sample(point).gradient.normalized();
  const double x = point.x();
  const double y = point.y();
  // A darker saddle, a pale underside, front and socks.
  const double trunk = ramp(-0.24, -0.15, x);
  mix(color, kSaddle, 0.75 * trunk * ramp(0.32, 0.44, y));
  mix(color, kCream,
      0.9 * ramp(0.25, 0.85, -normal.y()) * (1.0 - ramp(0.40, 0.50, y)) * ramp(0.12, 0.22, y));
  mix(color, kCream,
      0.9 * ramp(0.30, 0.75, -normal.x()) * ramp(0.22, 0.28, y) * (1.0 - ramp(0.40, 0.52, y)) *
          (1.0 - ramp(-0.20, -0.15, x)));
  mix(color, kCream, 0.95 * (1.0 - ramp(0.045, 0.11, y)));
  mix(color, kCream, 0.85 * belongs(body, "muzzle", point, 0.014));
  for (const std::string side : {"left", "right"}) {
    mix(color, kEar, belongs(body, side + " ear", point, 0.009));
    const Furrow& mouth = body.furrow(side + " mouth");
    if (mouth.curve.bounds().exteriorDistance(point) < 0.01)
      mix(color, kMouth, 0.9 * (1.0 - ramp(0.0010, 0.0030, mouth.curve.curve_distance(point))));
    paint_eye(body, side, point, color);
  }
  mix(color, kNose, 1.0 - ramp(0.0002, 0.0032, body.part("nose").distance(point)));
  return color;
}

}  // namespace dog
