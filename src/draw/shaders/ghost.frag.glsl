// Like thin glass: clear where one looks straight through, brighter and denser at the rim.
in vec3 at_world;
in vec3 at_normal;
in vec3 at_color;
in vec2 at_texcoord;

layout(location = 1) uniform vec3 base_color;
layout(location = 3) uniform int textured;
layout(location = 4) uniform float opacity;
layout(binding = 0) uniform sampler2D color_texture;

out vec4 color;

void main() {
  vec3 normal = normalize(at_normal);
  vec3 to_eye = normalize(frame.eye.xyz - at_world);
  float facing = abs(dot(normal, to_eye));
  float rim = pow(1.0 - facing, 2.2);
  vec3 body = base_color * at_color;
  if (textured != 0) body *= texture(color_texture, at_texcoord).rgb;
  vec3 glint = reflected_studio(reflect(-to_eye, normal), 0.25);
  vec3 light = body * (0.55 + 0.45 * irradiance(normal)) + (0.06 + 0.20 * rim) * glint;
  color = vec4(encoded(light), clamp(opacity * mix(0.42, 1.35, rim), 0.0, 1.0));
}
