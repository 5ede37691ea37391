#include <cstdio>

#include "nade/eval/quantile.h"
#include "nade/io/object_file.h"

int main() {
  const auto ball = nade::load_object("sphere:0.1");
  if (!ball) {
    std::fprintf(stderr, "%s\n", ball.error().message.c_str());
    return 1;
  }
  std::printf("%s has %zu place(s) to stroke\n", ball->spec.c_str(), ball->places.size());
  nade::QuantileSketch depths;
  depths.add(0.02);
  if (!depths.max()) return 1;
  return ball->places.empty() ? 1 : 0;
}
