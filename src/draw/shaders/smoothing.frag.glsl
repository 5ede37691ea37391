// The mean over 4 x 4 pixels of the same surface: what the pattern of taps needs to be smooth.
layout(binding = 1) uniform sampler2D depths;
layout(binding = 2) uniform sampler2D normals;
layout(binding = 3) uniform sampler2D visibilities;

out vec2 visibility;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(depths, pixel, 0).r;
  if (depth <= 0.0) {
    visibility = vec2(1.0);
    return;
  }
  vec3 position = eye_position(gl_FragCoord.xy, depth);
  vec3 normal = mat3(frame.view) * unpacked_normal(texelFetch(normals, pixel, 0).rg);
  // What lies off the surface's plane by more than a pixel's width is another surface.
  float scale = 0.6 / (depth * frame.unproject.y * 2.0 * frame.size.w + 0.0003);
  vec2 sum = vec2(0.0);
  float weights = 0.0;
  for (int y = -2; y <= 1; ++y) {
    for (int x = -2; x <= 1; ++x) {
      ivec2 tap = clamp(pixel + ivec2(x, y), ivec2(0), ivec2(frame.size.xy) - 1);
      float tap_depth = texelFetch(depths, tap, 0).r;
      vec3 to_tap = eye_position(vec2(tap) + 0.5, tap_depth) - position;
      float weight = max(1.0 - scale * abs(dot(to_tap, normal)), 0.0);
      weight = x == 0 && y == 0 ? 1.0 : weight;
      sum += weight * texelFetch(visibilities, tap, 0).rg;
      weights += weight;
    }
  }
  visibility = sum / weights;
}
