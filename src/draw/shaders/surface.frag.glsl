in vec3 at_world;
in vec3 at_normal;
in vec3 at_color;
in vec2 at_texcoord;
in vec3 at_rest;
in float at_depth;

layout(location = 1) uniform vec3 base_color;
layout(location = 2) uniform vec4 material;  // roughness, metalness, sheen, translucency
layout(location = 3) uniform int textured;
layout(binding = 0) uniform sampler2D color_texture;

out vec4 color;

struct Surface {
  vec3 normal;
  vec3 to_eye;
  vec3 albedo;
  vec3 mirror;  // reflectance head on
  float roughness;
};

// Based on: Walter, Marschner, Li, Torrance. Microfacet Models for Refraction through Rough
// Surfaces. 2007 (GGX); Heitz. Understanding the Masking-Shadowing Function. 2014 (Smith);
// Schlick. An Inexpensive BRDF Model. 1994 (Fresnel).
vec3 glossy(Surface s, vec3 to_light, float widen) {
  float a = clamp(s.roughness * s.roughness + widen, 0.002, 1.0);
  vec3 halfway = normalize(to_light + s.to_eye);
  float nl = clamp(dot(s.normal, to_light), 0.0, 1.0);
  float nv = clamp(dot(s.normal, s.to_eye), 1e-3, 1.0);
  float nh = clamp(dot(s.normal, halfway), 0.0, 1.0);
  float vh = clamp(dot(s.to_eye, halfway), 0.0, 1.0);
  float a2 = a * a;
  float d = nh * nh * (a2 - 1.0) + 1.0;
  float spread = s.roughness * s.roughness;
  float normalized = spread * spread / max(a2, 1e-6);
  float lobe = a2 / (kPi * d * d);
  float masked = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) +
                        nv * sqrt(nl * nl * (1.0 - a2) + a2) + 1e-4);
  vec3 fresnel = s.mirror + (1.0 - s.mirror) * pow(1.0 - vh, 5.0);
  return fresnel * lobe * masked * nl * mix(1.0, normalized, widen > 0.0 ? 0.5 : 0.0);
}

/// What the studio's walls add to a surface's gloss.
// Based on: Karis. Physically Based Shading on Mobile. 2014 (the fit).
vec3 wall_gloss(Surface s) {
  vec4 r = s.roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float nv = clamp(dot(s.normal, s.to_eye), 0.0, 1.0);
  float grazing = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
  vec2 scale = vec2(-1.04, 1.04) * grazing + r.zw;
  vec3 direction = reflect(-s.to_eye, s.normal);
  return reflected_studio(direction, s.roughness) * (s.mirror * scale.x + scale.y);
}

/// Diffuse light of one lamp; in flesh it spreads past the edge of the shadow, red farthest.
vec3 diffuse(float facing, float translucency) {
  vec3 wrap = translucency * vec3(0.55, 0.22, 0.14);
  vec3 wrapped = clamp((facing + wrap) / (1.0 + wrap), 0.0, 1.0);
  return mix(vec3(clamp(facing, 0.0, 1.0)), wrapped * wrapped, step(1e-4, translucency)) / 1.0;
}

vec3 lit(Surface s, float key, float open, float sheen, float translucency) {
  vec3 bleed = mix(vec3(1.0), vec3(0.72, 1.05, 1.12), translucency);
  vec3 key_light = kKeyColor * pow(vec3(key), bleed);
  vec3 ambient_open = pow(vec3(open), mix(vec3(1.0), vec3(0.70, 1.0, 1.05), translucency));
  float nk = dot(s.normal, frame.key_light.xyz);
  float nf = dot(s.normal, frame.fill_light.xyz);
  float nr = dot(s.normal, frame.rim_light.xyz);
  vec3 light = key_light * diffuse(nk, translucency);
  light += kFillColor * ambient_open * diffuse(nf, translucency);
  light += kRimColor * ambient_open * diffuse(nr, translucency);
  vec3 result = s.albedo * (light / kPi * 1.0 + irradiance(s.normal) * ambient_open * 0.62);
  result += kKeyColor * key * glossy(s, frame.key_light.xyz, 0.5 * frame.key_light.w);
  result += kFillColor * open * glossy(s, frame.fill_light.xyz, 0.0);
  result += kRimColor * open * glossy(s, frame.rim_light.xyz, 0.0);
  float nv = clamp(dot(s.normal, s.to_eye), 0.0, 1.0);
  float shut = clamp(open + pow(nv + open, 2.0) - 1.0, 0.0, 1.0);
  result += wall_gloss(s) * min(open, shut);
  // Fibres catch light at the rim.
  float rim = pow(1.0 - nv, 3.0);
  result += sheen * rim * open * s.albedo * (0.6 * irradiance(s.normal) + 0.35 * key_light);
  return result;
}

void main() {
  Surface s;
  s.normal = normalize(gl_FrontFacing ? at_normal : -at_normal);
  s.to_eye = normalize(frame.eye.xyz - at_world);
  s.albedo = base_color * at_color;
  if (textured != 0) s.albedo *= texture(color_texture, at_texcoord).rgb;
  s.roughness = clamp(material.x, 0.05, 1.0);
  float metalness = material.y;
  s.mirror = mix(vec3(0.04), s.albedo, metalness);
  s.albedo *= 1.0 - metalness;
  vec2 light = received_light(at_depth);
  color = vec4(encoded(filmed(lit(s, light.x, light.y, material.z, material.w))), 1.0);
}
