// look_at_eyes LEFT.png RIGHT.png: whether what `nade xr --screenshot` saw for the person of
// remote_hands shows a room and a hand, from two eyes that stand apart.
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "nade/draw/image.h"
#include "remote_hands.h"

namespace nade::test {
namespace {

struct Sight {
  double brightness = 0.0;  ///< mean, 0 to 1
  std::size_t skin = 0;     ///< pixels
  double right = 0.0;       ///< of the skin's middle: tangent of the angle to the right of ahead
};

bool is_skin(const std::uint8_t* pixel) {
  const int r = pixel[0];
  const int g = pixel[1];
  const int b = pixel[2];
  return r > 90 && r > g + 18 && g > b && r - b > 35;
}

Sight look(const draw::Image& image, const draw::FieldOfView& view) {
  Sight sight;
  const double left = std::tan(view.left);
  const double step = (std::tan(view.right) - left) / image.width;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* const pixel =
          image.rgba.data() +
          4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
               static_cast<std::size_t>(x));
      sight.brightness += (pixel[0] + pixel[1] + pixel[2]) / 765.0;
      if (!is_skin(pixel)) continue;
      ++sight.skin;
      sight.right += left + (x + 0.5) * step;
    }
  }
  sight.brightness /= static_cast<double>(image.width) * image.height;
  if (sight.skin > 0) sight.right /= static_cast<double>(sight.skin);
  return sight;
}

int judge(const std::array<Sight, 2>& sights, const RemoteState& person) {
  for (const Sight& sight : sights) {
    std::printf("brightness %.2f, %zu pixels of skin, %.3f to the right\n", sight.brightness,
                sight.skin, sight.right);
    if (sight.brightness < 0.15 || sight.brightness > 0.95 || sight.skin < 300) {
      std::printf("expected a lit room with a hand\n");
      return 1;
    }
  }
  const double apart_m = (person.eyes[1].position - person.eyes[0].position).norm();
  const double away_m = apart_m / (sights[0].right - sights[1].right);
  std::printf("= by parallax the hand is %.2f m away\n", away_m);
  if (!(away_m > 0.3 && away_m < 0.8)) {
    std::printf("expected the hand at an arm's length\n");
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace nade::test

int main(int argc, char** argv) {
  using namespace nade;
  if (argc != 3) return 2;
  const test::RemoteState person = test::looking_down();
  std::array<test::Sight, 2> sights;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const Result<draw::Image> image = draw::load_image(argv[eye + 1]);
    if (!image) {
      std::printf("%s\n", image.error().message.c_str());
      return 1;
    }
    sights[eye] = test::look(*image, person.views[eye]);
  }
  return test::judge(sights, person);
}
