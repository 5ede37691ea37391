layout(location = 0) in vec3 position;
layout(location = 0) uniform mat4 model;
layout(location = 1) uniform int wide;

void main() {
  mat4 to_map = wide == 0 ? frame.near_shadow : frame.wide_shadow;
  vec3 place = (to_map * (model * vec4(position, 1.0))).xyz;
  gl_Position = vec4(2.0 * place - 1.0, 1.0);
}
