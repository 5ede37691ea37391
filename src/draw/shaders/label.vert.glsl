layout(location = 0) in vec4 place;
layout(location = 1) in vec2 atlas;
layout(location = 2) in vec3 color;

flat out vec3 at_color;
noperspective out vec2 at_texel;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec2 pixel = place.xy + corner * place.zw;
  gl_Position = vec4(2.0 * pixel.x * frame.size.z - 1.0, 1.0 - 2.0 * pixel.y * frame.size.w, 0.0,
                     1.0);
  at_texel = atlas + corner * place.zw;
  at_color = color;
}
