#pragma once

#include <string>
#include <vector>

#include "make_dog_shape.h"

namespace dog {

/// A spot to stroke.
struct Place {
  std::string name;
  Vec3 position;
  Vec3 normal;     ///< unit, out of the surface
  Vec3 direction;  ///< unit, in the surface: with the lie of the coat
};

/// A standing dog of 0.45 m at the withers: metres, on y = 0, nose toward -X, left flank at +Z.
[[nodiscard]] Body make_body();

/// The coat's colour at a point of the surface, sRGB from 0 to 1.
[[nodiscard]] Vec3 coat_color(const Body& body, const Vec3& point);

/// The spots to stroke: back, flank, head, ear, leg.
[[nodiscard]] std::vector<Place> find_places(const Body& body);

}  // namespace dog
