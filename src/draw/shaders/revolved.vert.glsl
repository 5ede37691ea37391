// Arrows and dots: a profile turned about the line from `from` to `to`.
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec3 color;
layout(location = 3) in float radius;
layout(location = 4) in vec3 profile;  // distance from the axis, 0 or 1 for the end, along: radii
layout(location = 5) in vec2 slope;    // normal: away from the axis, along it
layout(location = 6) in vec2 turn;     // cosine and sine

flat out vec3 at_color;
out vec3 at_normal;
out vec3 at_world;

void main() {
  vec3 span = to - from;
  float span_length = length(span);
  vec3 axis = span_length > 1e-9 ? span / span_length : vec3(0.0, 1.0, 0.0);
  vec3 side = normalize(cross(axis, abs(axis.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
  vec3 out_wards = turn.x * side + turn.y * cross(axis, side);
  at_world = mix(from, to, profile.y) + radius * (profile.z * axis + profile.x * out_wards);
  at_normal = slope.x * out_wards + slope.y * axis;
  at_color = color;
  gl_Position = frame.projection * (frame.view * vec4(at_world, 1.0));
}
