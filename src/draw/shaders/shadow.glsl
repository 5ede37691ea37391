// Soft shadows of the key light, a disk seen under a small angle: first what stands in the light
// and how far off, then as much blur as such a disk gives at that distance.
// Based on: Fernando. Percentage-Closer Soft Shadows. 2005. Changed: a blocker counts only inside
// the cone from the point to the light, so that what touches casts a sharp shadow.
layout(binding = 4) uniform sampler2DShadow near_shadow_map;
layout(binding = 5) uniform sampler2DShadow wide_shadow_map;
layout(binding = 6) uniform sampler2D near_shadow_depth;
layout(binding = 7) uniform sampler2D wide_shadow_depth;

const int kShadowTaps = 16;
/// A sunflower in the unit disk.
const vec2 kShadowDisk[kShadowTaps] = vec2[](
    vec2(0.17678, 0.00000), vec2(-0.22577, 0.20682), vec2(0.03456, -0.39377),
    vec2(0.28457, 0.37112), vec2(-0.52223, -0.09236), vec2(0.49466, -0.31467),
    vec2(-0.16563, 0.61552), vec2(-0.31579, -0.60727), vec2(0.68389, 0.25004),
    vec2(-0.71256, 0.29377), vec2(0.34362, -0.73360), vec2(0.25343, 0.80918),
    vec2(-0.76464, -0.44350), vec2(0.89723, -0.19685), vec2(-0.54787, 0.77850),
    vec2(-0.12593, -0.97609));

/// How much of the key light arrives, from one of the maps; `turn` turns the taps.
float light_through(sampler2DShadow map, sampler2D depths, mat4 to_map, vec3 extent, vec3 world,
                    vec3 normal, mat2 turn) {
  float width = extent.x;
  float range = extent.y;
  float texel = extent.z;
  // Off the surface by what the map cannot tell apart, no more: shadows reach what casts them.
  vec3 place = (to_map * vec4(world + (0.75 * texel + 0.0001) * normal, 1.0)).xyz;
  float bias = (0.5 * texel + 0.0002) / range;
  // How the surface rises towards the light over the map, so that wide blur does not shade it.
  vec3 right = vec3(to_map[0].x, to_map[1].x, to_map[2].x) * width;
  vec3 up = vec3(to_map[0].y, to_map[1].y, to_map[2].y) * width;
  float facing = max(dot(normal, frame.key_light.xyz), 0.25);
  vec2 rise = vec2(dot(normal, right), dot(normal, up)) / facing * width / range;
  float z = min(place.z - bias, 1.0);

  float widest = min(frame.key_light.w * range, 0.06) / width;
  float closeness = 0.0;
  float blockers = 0.0;
  for (int i = 0; i < kShadowTaps; ++i) {
    // Denser towards the middle, where near blockers are.
    vec2 unit = turn * kShadowDisk[i];
    vec2 offset = widest * unit * (float(i) + 0.5) / float(kShadowTaps);
    float gap = z + dot(rise, offset) - textureLod(depths, place.xy + offset, 0.0).r;
    float cone = gap * range * frame.key_light.w / width;
    if (gap > 0.0 && length(offset) < 1.5 * cone + 1.5 * texel / width) {
      closeness += gap;
      blockers += 1.0;
    }
  }
  if (blockers == 0.0) return texture(map, vec3(place.xy, z));
  float blur = closeness / blockers * range * frame.key_light.w;
  blur = clamp(blur, 1.2 * texel, 0.06) / width;
  float light = 0.0;
  for (int i = 0; i < kShadowTaps; ++i) {
    vec2 offset = blur * (turn * kShadowDisk[i]);
    light += texture(map, vec3(place.xy + offset, min(z + dot(rise, offset), 1.0)));
  }
  return light / float(kShadowTaps);
}

float key_light_at(vec3 world, vec3 normal, mat2 turn) {
  vec2 near = abs((frame.near_shadow * vec4(world, 1.0)).xy - 0.5);
  // The map about the focus ends where its blur would reach past its border.
  float margin = 0.5 - 0.03 / frame.near_extent.x;
  float out_of_near = smoothstep(0.85 * margin, margin, max(near.x, near.y));
  float light = 0.0;
  if (out_of_near < 1.0) {
    light += (1.0 - out_of_near) * light_through(near_shadow_map, near_shadow_depth,
                                                 frame.near_shadow, frame.near_extent.xyz, world,
                                                 normal, turn);
  }
  if (out_of_near > 0.0) {
    light += out_of_near * light_through(wide_shadow_map, wide_shadow_depth, frame.wide_shadow,
                                         frame.wide_extent.xyz, world, normal, turn);
  }
  return light;
}
