// A square of floor about what the picture is of.
out vec3 at_world;
out vec3 at_normal;
out float at_depth;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  vec2 reach = frame.floor_place.z * vec2(corner.x, -corner.y);
  vec4 world = vec4(frame.focus.x + reach.x, frame.floor_place.x, frame.focus.z + reach.y, 1.0);
  vec4 seen = frame.view * world;
  gl_Position = frame.projection * seen;
  at_world = world.xyz;
  at_normal = vec3(0.0, 1.0, 0.0);
  at_depth = -seen.z;
}
