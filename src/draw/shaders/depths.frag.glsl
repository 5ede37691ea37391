in vec3 at_normal;
in float at_depth;

layout(location = 0) out float depth;
layout(location = 1) out vec2 normal;

void main() {
  depth = at_depth;
  vec3 n = normalize(at_normal);
  normal = packed_normal(gl_FrontFacing ? n : -n);
}
