// Soft shadows of the key light, a disk seen under a small angle: first what stands in the light
// and how far off, then as much blur as such a disk gives at that distance.
// Based on: Fernando. Percentage-Closer Soft Shadows. 2005. Changed: a blocker counts only inside
// the cone from the point to the light, so that what touches casts a sharp shadow.
// The map about the focus, then that about everything.
layout(binding = 4) uniform sampler2DArray shadow_maps;

const int kBlockerTaps = 6;
const int kShadowTaps = 8;
const float kWidestBlur = 0.06;  // metres
/// A sunflower in the unit disk.
const vec2 kShadowDisk[kShadowTaps] = vec2[](
    vec2(0.25000, 0.00000), vec2(-0.31929, 0.29250), vec2(0.04887, -0.55688),
    vec2(0.40244, 0.52492), vec2(-0.73854, -0.13064), vec2(0.69960, -0.44503),
    vec2(-0.23400, 0.87048), vec2(-0.44627, -0.85927));

float map_depth(int map, vec2 place) {
  ivec2 size = textureSize(shadow_maps, 0).xy;
  ivec2 texel = clamp(ivec2(place * vec2(size)), ivec2(0), size - 1);
  return texelFetch(shadow_maps, ivec3(texel, map), 0).r;
}

/// How much of the key light arrives. `turn` turns the taps; `pick`, 0 to 1, is the pixel's own, by
/// which one map gives way to the other.
float key_light_at(vec3 world, vec3 normal, mat2 turn, float pick) {
  vec2 near = abs((frame.near_shadow * vec4(world, 1.0)).xy - 0.5);
  // The map about the focus ends where its blur would reach past its border.
  float margin = 0.5 - 0.5 * kWidestBlur / frame.near_extent.x;
  int map = smoothstep(0.85 * margin, margin, max(near.x, near.y)) > pick ? 1 : 0;
  mat4 to_map = map == 0 ? frame.near_shadow : frame.wide_shadow;
  vec3 extent = map == 0 ? frame.near_extent.xyz : frame.wide_extent.xyz;
  vec4 casters = map == 0 ? frame.near_casters : frame.wide_casters;
  float width = extent.x;
  float range = extent.y;
  float texel = extent.z;
  // Off the surface by what the map cannot tell apart, no more: shadows reach what casts them.
  // Where light only grazes, more, so that the triangles' own edges do not show.
  float facing = max(dot(normal, frame.key_light.xyz), 0.25);
  float off = 0.75 * texel + 0.0001 + 0.0012 * (1.0 - facing) * (1.0 - facing);
  vec3 place = (to_map * vec4(world + off * normal, 1.0)).xyz;
  // Where nothing can stand in the light, or none falls anyway (flesh lets some round the edge), the
  // loops take no turn: cheaper, where shaders run on the processor, than a branch.
  bool open = any(lessThan(place.xy, casters.xy)) || any(greaterThan(place.xy, casters.zw));
  bool away_from_light = dot(normal, frame.key_light.xyz) < -0.25;
  bool asked = !open && !away_from_light;
  float bias = (0.5 * texel + 0.0002) / range;
  // How the surface rises towards the light over the map, so that wide blur does not shade it.
  vec3 right = vec3(to_map[0].x, to_map[1].x, to_map[2].x) * width;
  vec3 up = vec3(to_map[0].y, to_map[1].y, to_map[2].y) * width;
  vec2 rise = vec2(dot(normal, right), dot(normal, up)) / facing * width / range;
  float z = min(place.z - bias, 1.0);

  float widest = min(frame.key_light.w * range, kWidestBlur) / width;
  float to_cone = range * frame.key_light.w / width;
  float slack = 1.5 * texel / width;
  float closeness = 0.0;
  float blockers = 0.0;
  for (int i = asked ? 0 : kBlockerTaps; i < kBlockerTaps; ++i) {
    // Denser towards the middle, where near blockers are.
    float away = widest * (float(i) + 0.5) / float(kBlockerTaps);
    vec2 offset = away * (turn * kShadowDisk[min(i, kShadowTaps - 1)]);
    float gap = z + dot(rise, offset) - map_depth(map, place.xy + offset);
    float counts = step(away, 1.5 * gap * to_cone + slack) * step(0.0, gap);
    closeness += counts * gap;
    blockers += counts;
  }
  bool blocked = blockers > 0.0;
  float blur = closeness / max(blockers, 1.0) * range * frame.key_light.w;
  blur = clamp(blur, 1.2 * texel, kWidestBlur) / width;
  float light = 0.0;
  for (int i = blocked ? 0 : kShadowTaps; i < kShadowTaps; ++i) {
    vec2 offset = blur * (turn * kShadowDisk[min(i, kShadowTaps - 1)]);
    light += step(min(z + dot(rise, offset), 1.0), map_depth(map, place.xy + offset));
  }
  if (blocked) return light / float(kShadowTaps);
  return asked ? step(z, map_depth(map, place.xy)) : float(open);
}
