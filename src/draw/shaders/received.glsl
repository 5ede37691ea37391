layout(binding = 1) uniform sampler2D depths;
layout(binding = 3) uniform sampler2D visibilities;

/// What the occlusion pass found for a surface at this pixel and depth: at an edge the pixel may
/// show another surface, then from the neighbour that shows this one.
vec2 received_light(float depth) {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float off = abs(texelFetch(depths, pixel, 0).r - depth);
  ivec2 best = pixel;
  if (off > 0.004) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        ivec2 tap = clamp(pixel + ivec2(x, y), ivec2(0), ivec2(frame.size.xy) - 1);
        float tap_off = abs(texelFetch(depths, tap, 0).r - depth);
        if (tap_off < off) {
          off = tap_off;
          best = tap;
        }
      }
    }
  }
  return texelFetch(visibilities, best, 0).rg;
}
