out vec4 color;

void main() {
  vec3 direction = normalize(to_world(eye_position(gl_FragCoord.xy, 1.0)) - frame.eye.xyz);
  color = vec4(encoded(backdrop(direction)), 1.0);
}
