// Lit a little, so that the colour stays that of the legend.
flat in vec3 at_color;
in vec3 at_normal;
in vec3 at_world;

layout(location = 0) uniform float opacity;
out vec4 color;

void main() {
  vec3 normal = normalize(at_normal);
  vec3 to_eye = normalize(frame.eye.xyz - at_world);
  vec3 halfway = normalize(to_eye + frame.key_light.xyz);
  float facing = 0.5 + 0.5 * dot(normal, frame.key_light.xyz);
  float glint = 0.35 * pow(clamp(dot(normal, halfway), 0.0, 1.0), 40.0);
  color = vec4(encoded(at_color * (0.45 + 0.62 * facing) + glint), opacity);
}
