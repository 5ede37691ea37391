flat in vec3 at_color;
flat in float at_half_width;
noperspective in float at_across;

layout(location = 0) uniform float opacity;
out vec4 color;

void main() {
  float cover = clamp(at_half_width + 0.5 - abs(at_across), 0.0, 1.0);
  if (cover <= 0.0) discard;
  color = vec4(encoded(at_color), opacity * cover);
}
