// Based on: McGuire, Mara, Luebke. Scalable Ambient Obscurance. 2012 (the estimator).
layout(binding = 1) uniform sampler2D depths;
layout(binding = 2) uniform sampler2D normals;

out vec2 visibility;  ///< of the key light, of the surroundings

/// Two reaches, metres: what stands about, and the crease where skin meets what it touches.
const int kFarTaps = 9;
const int kNearTaps = 5;
const float kFarReach = 0.032;
const float kNearReach = 0.008;
const float kFarStrength = 1.7;
const float kNearStrength = 1.8;
const float kBias = 0.0004;  // metres
/// The directions of a spiral of five turns.
const vec2 kSpiral[kFarTaps + kNearTaps] = vec2[](
    vec2(1.0, 0.0), vec2(-0.8660254, 0.5), vec2(0.5, -0.8660254), vec2(0.0, 1.0),
    vec2(-0.5, -0.8660254), vec2(0.8660254, 0.5), vec2(-1.0, 0.0), vec2(0.8660254, -0.5),
    vec2(-0.5, 0.8660254), vec2(0.0, -1.0), vec2(0.5, 0.8660254), vec2(-0.8660254, -0.5),
    vec2(1.0, 0.0), vec2(-0.8660254, 0.5));

/// 0 to 1: each pixel of every 4 x 4 has a value of its own, so that these 16 make a fine whole.
float pattern(ivec2 pixel) {
  ivec2 p = pixel & 3;
  const int kOrder[16] = int[](0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5);
  return (float(kOrder[p.y * 4 + p.x]) + 0.5) / 16.0;
}

/// What is open of the surroundings within a reach; the taps start at `first` of the spiral.
float open_within(float full_reach, float strength, int first, int taps, bool asked, ivec2 pixel,
                  vec3 position, vec3 normal, float turn, mat2 turned) {
  float metre_px = 0.5 * frame.size.y / (frame.unproject.y * -position.z);
  float reach_px = min(full_reach * metre_px, 0.15 * frame.size.y);
  float reach = reach_px / metre_px;
  ivec2 last = ivec2(frame.size.xy) - 1;
  float sum = 0.0;
  for (int i = asked && reach_px >= 1.5 ? 0 : taps; i < taps; ++i) {
    float share = (float(i) + turn) / float(taps);
    vec2 direction = turned * kSpiral[min(first + i, kFarTaps + kNearTaps - 1)];
    ivec2 tap = pixel + ivec2(round(share * reach_px * direction));
    tap = clamp(tap, ivec2(0), last);
    float depth = texelFetch(depths, tap, 0).r;
    vec3 to_tap = eye_position(vec2(tap) + 0.5, depth) - position;
    float far2 = dot(to_tap, to_tap);
    float above = dot(to_tap, normal) - kBias - 0.02 * sqrt(far2);
    float near = max(reach * reach - far2, 0.0);
    sum += near * near * near * max(above, 0.0) / (far2 + 1e-6);
  }
  float reach3 = reach * reach * reach;
  // Never quite dark: light comes round by way of other surfaces.
  return 1.0 / (1.0 + sum * strength * 5.0 * reach / (reach3 * reach3 * float(taps)));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(depths, pixel, 0).r;
  if (depth <= 0.0) {
    visibility = vec2(1.0);
    return;
  }
  vec3 position = eye_position(gl_FragCoord.xy, depth);
  vec3 normal = unpacked_normal(texelFetch(normals, pixel, 0).rg);
  float turn = pattern(pixel);
  float angle = 6.2831853 * turn;
  mat2 turned = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
  vec3 world = to_world(position);
  visibility.x = key_light_at(world, normal, turned, turn);
  // Far from all solids the floor is open.
  bool asked = all(greaterThan(world, frame.solids_low.xyz - kFarReach)) &&
               all(lessThan(world, frame.solids_high.xyz + kFarReach));
  vec3 seen = mat3(frame.view) * normal;
  float near = open_within(kNearReach, kNearStrength, kFarTaps, kNearTaps, asked, pixel, position,
                           seen, turn, turned);
  float far = open_within(kFarReach, kFarStrength, 0, kFarTaps, asked, pixel, position, seen, turn,
                          turned);
  visibility.y = mix(0.4, 1.0, near) * far;
}
