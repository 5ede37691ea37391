flat in vec3 at_color;
noperspective in vec2 at_texel;

layout(location = 0) uniform int halo;
layout(binding = 0) uniform sampler2D atlas;

out vec4 color;

void main() {
  vec2 cover = texelFetch(atlas, ivec2(at_texel), 0).rg;
  vec3 letter = encoded(at_color);
  // Light about dark letters and the other way round.
  float brightness = dot(letter, vec3(0.3, 0.59, 0.11));
  vec3 around = brightness < 0.75 ? vec3(1.0) : vec3(0.12);
  color = halo != 0 ? vec4(around, 0.80 * cover.g) : vec4(letter, cover.r);
}
