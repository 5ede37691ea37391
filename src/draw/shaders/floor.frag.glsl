// The floor is the backdrop carried on, with the shadows that fall on it.
in vec3 at_world;
in float at_depth;

out vec4 color;

void main() {
  vec3 to_floor = at_world - frame.eye.xyz;
  vec3 wall = backdrop(normalize(to_floor));
  vec2 light = received_light(at_depth);
  float away = length(at_world.xz - frame.focus.xz);
  float fade = smoothstep(0.95 * frame.floor_place.z, 0.3 * frame.floor_place.z, away);
  vec3 shade = mix(vec3(0.50, 0.51, 0.54), vec3(1.0), light.x) * mix(0.35, 1.0, light.y);
  color = vec4(encoded(wall * mix(vec3(1.0), shade, fade)), 1.0);
}
