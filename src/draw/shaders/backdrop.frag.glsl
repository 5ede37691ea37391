// Backdrop and floor: the floor is the backdrop carried on, with the shadows that fall on it.
out vec4 color;

void main() {
  vec3 ray = to_world(eye_position(gl_FragCoord.xy, 1.0)) - frame.eye.xyz;
  vec3 wall = backdrop(normalize(ray));
  // Before the eye by so many metres along its axis.
  float depth = (frame.floor_place.x - frame.eye.y) / ray.y;
  if (frame.floor_place.y > 0.0 && ray.y < 0.0 && depth > 0.0) {
    float away = length(frame.eye.xz + depth * ray.xz - frame.focus.xz);
    if (away < frame.floor_place.z) {
      vec2 light = received_light(depth);
      float fade = smoothstep(0.95 * frame.floor_place.z, 0.3 * frame.floor_place.z, away);
      vec3 shade = mix(vec3(0.42, 0.43, 0.465), vec3(1.0), light.x) * mix(0.2, 1.0, light.y);
      wall *= mix(vec3(1.0), shade, fade);
    }
  }
  color = vec4(grained(encoded(wall)), 1.0);
}
