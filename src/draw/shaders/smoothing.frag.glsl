// The mean over 4 x 4 pixels of the same surface: what the pattern of taps needs to be smooth.
layout(binding = 1) uniform sampler2D depths;
layout(binding = 2) uniform sampler2D normals;
layout(binding = 3) uniform sampler2D visibilities;

out vec2 visibility;

/// The places of the four pixels that textureGather gives, from the low left one.
const vec2 kGathered[4] = vec2[](vec2(0.0, 1.0), vec2(1.0, 1.0), vec2(1.0, 0.0), vec2(0.0, 0.0));

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 key[4];
  vec4 open[4];
  vec2 corners[4];
  vec4 low = vec4(1.0);
  vec4 high = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    // Between the low left pixel of four and its neighbours.
    corners[i] = gl_FragCoord.xy + vec2(2 * (i & 1) - 2, (i & 2) - 2);
    vec2 at = (corners[i] + 0.5) * frame.size.zw;
    key[i] = textureGather(visibilities, at, 0);
    open[i] = textureGather(visibilities, at, 1);
    low = min(low, min(key[i], open[i]));
    high = max(high, max(key[i], open[i]));
  }
  // All the same: as it is, on floors and in the open.
  if (all(equal(low, vec4(1.0)))) {
    visibility = vec2(1.0);
    return;
  }
  float depth = texelFetch(depths, pixel, 0).r;
  vec3 position = eye_position(gl_FragCoord.xy, depth);
  vec3 normal = mat3(frame.view) * unpacked_normal(texelFetch(normals, pixel, 0).rg);
  // What lies off the surface's plane by more than a pixel's width is another surface.
  float scale = 0.6 / (depth * frame.unproject.y * 2.0 * frame.size.w + 0.0003);
  vec2 sum = 0.001 * texelFetch(visibilities, pixel, 0).rg;
  float weights = 0.001;
  for (int i = 0; i < 4; ++i) {
    vec4 depths_there = textureGather(depths, (corners[i] + 0.5) * frame.size.zw, 0);
    for (int k = 0; k < 4; ++k) {
      vec3 there = eye_position(corners[i] + kGathered[k], depths_there[k]);
      float weight = max(1.0 - scale * abs(dot(there - position, normal)), 0.0);
      sum += weight * vec2(key[i][k], open[i][k]);
      weights += weight;
    }
  }
  visibility = sum / weights;
}
