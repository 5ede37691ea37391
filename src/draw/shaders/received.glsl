layout(binding = 1) uniform sampler2D depths;
layout(binding = 3) uniform sampler2D visibilities;

/// What the occlusion pass found for a surface at this pixel and depth: at an edge the pixel may
/// show another surface, then from the neighbour that shows this one.
vec2 received_light(float depth) {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float off = abs(texelFetch(depths, pixel, 0).r - depth);
  ivec2 best = pixel;
  // A loop without a turn, where a branch would cost as much as its work on a processor.
  for (int i = off > 0.004 ? 0 : 9; i < 9; ++i) {
    ivec2 tap = clamp(pixel + ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), ivec2(frame.size.xy) - 1);
    float tap_off = abs(texelFetch(depths, tap, 0).r - depth);
    best = tap_off < off ? tap : best;
    off = min(off, tap_off);
  }
  return texelFetch(visibilities, best, 0).rg;
}
