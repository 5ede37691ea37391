layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 color;
layout(location = 3) in vec2 texcoord;
layout(location = 4) in vec3 rest;

layout(location = 0) uniform mat4 model;

out vec3 at_world;
out vec3 at_normal;
out vec3 at_color;
out vec2 at_texcoord;
out vec3 at_rest;
out float at_depth;

// Ghosts are drawn twice and must fall on the same depths.
invariant gl_Position;

void main() {
  vec4 world = model * vec4(position, 1.0);
  vec4 seen = frame.view * world;
  gl_Position = frame.projection * seen;
  at_world = world.xyz;
  at_normal = mat3(model) * normal;
  at_color = color;
  at_texcoord = texcoord;
  at_rest = rest;
  at_depth = -seen.z;
}
