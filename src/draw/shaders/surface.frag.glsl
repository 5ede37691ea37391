// With TEXTURE, SKIN and COAT as the material asks: a branch would cost as much as its work where
// shaders run on the processor.
in vec3 at_world;
in vec3 at_normal;
in vec3 at_color;
in vec2 at_texcoord;
in vec3 at_rest;
in float at_depth;

layout(location = 0) uniform mat4 model;
layout(location = 1) uniform vec3 base_color;
layout(location = 2) uniform vec4 material;  // roughness, metalness, sheen, translucency
layout(binding = 0) uniform sampler2D color_texture;

out vec4 color;

struct Surface {
  vec3 normal;
  vec3 to_eye;
  vec3 albedo;
  vec3 mirror;  // reflectance head on
  float roughness;
};

/// The gloss of the key light, a disk: a little wider and as much dimmer than of a point.
// Based on: Walter, Marschner, Li, Torrance. Microfacet Models for Refraction through Rough
// Surfaces. 2007 (GGX); Hammon. PBR Diffuse Lighting for GGX+Smith Microsurfaces. 2017 (the
// approximate Smith term); Schlick. An Inexpensive BRDF Model. 1994 (Fresnel); Karis. Real Shading
// in Unreal Engine 4. 2013 (the disk).
vec3 key_gloss(Surface s) {
  vec3 to_light = frame.key_light.xyz;
  vec3 halfway = normalize(to_light + s.to_eye);
  float nl = clamp(dot(s.normal, to_light), 0.0, 1.0);
  float nv = clamp(dot(s.normal, s.to_eye), 1e-3, 1.0);
  float nh = clamp(dot(s.normal, halfway), 0.0, 1.0);
  float vh = clamp(dot(s.to_eye, halfway), 0.0, 1.0);
  float a = s.roughness * s.roughness;
  float wide = min(a + 0.5 * frame.key_light.w, 1.0);
  float d = nh * nh * (wide * wide - 1.0) + 1.0;
  float lobe = a * a / (kPi * d * d);
  float masked = 0.5 / (mix(2.0 * nl * nv, nl + nv, a) + 1e-4);
  float miss = 1.0 - vh;
  float miss2 = miss * miss;
  vec3 fresnel = s.mirror + (1.0 - s.mirror) * miss2 * miss2 * miss;
  return fresnel * lobe * masked * nl;
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
vec3 diffuse(float facing, vec3 wrap) {
  vec3 wrapped = clamp((facing + wrap) / ((1.0 + wrap) * (1.0 + wrap)), 0.0, 1.0);
  return wrapped;
}

/// Half-shade of flesh is red: light that went in elsewhere.
vec3 bled(float light, float translucency) {
  return light + light * (1.0 - light) * translucency * vec3(0.55, -0.05, -0.12);
}

vec3 lit(Surface s, float key, float open, float sheen, float translucency) {
  vec3 wrap = translucency * vec3(0.42, 0.14, 0.08);
  vec3 key_light = kKeyColor * bled(key, translucency);
  vec3 around = bled(open, translucency);
  vec3 light = key_light * diffuse(dot(s.normal, frame.key_light.xyz), wrap);
  light += kFillColor * around * diffuse(dot(s.normal, frame.fill_light.xyz), wrap);
  light += kRimColor * around * diffuse(dot(s.normal, frame.rim_light.xyz), wrap);
  vec3 result = s.albedo * (light / kPi + 0.62 * irradiance(s.normal) * around);
  float nv = clamp(dot(s.normal, s.to_eye), 0.0, 1.0);
  result += kKeyColor * key * key_gloss(s);
  // Where much is shut out, so is what a mirror there would show.
  result += wall_gloss(s) * open * open * mix(0.45, 1.0, key);
  // Fibres catch light at the rim.
  float rim = (1.0 - nv) * (1.0 - nv) * (1.0 - nv);
  result += sheen * rim * open * s.albedo * (0.6 * irradiance(s.normal) + 0.35 * key_light);
  return result;
}

/// Pores and mottling, that stick to the skin as it moves.
void add_skin(inout Surface s, float pixel, float much) {
  float blotch = noise(at_rest * 130.0) + 0.5 * noise(at_rest * 330.0) - 0.75;
  s.albedo *= 1.0 + much * blotch * vec3(0.10, 0.17, 0.16);
  s.roughness = clamp(s.roughness + 0.10 * blotch, 0.2, 1.0);
  float fine = shown(0.0011, pixel);
  if (fine <= 0.0) return;
  float pores = noise(at_rest * 900.0) + 0.6 * noise(at_rest * 1900.0) * shown(0.0006, pixel);
  s.normal = bumped(s.normal, at_world, 0.00005 * much * fine * pores);
}

/// A short coat that lies from the head to the tail and down.
void add_coat(inout Surface s, vec3 normal_rest, float pixel, float much) {
  vec3 lie = vec3(-0.85, -0.5, 0.0);
  lie -= dot(lie, normal_rest) * normal_rest;
  lie = normalize(lie + 1e-4);
  // The hair does not all lie the same way.
  vec3 wave = sin(at_rest.yzx * 31.0 + 1.6 * sin(at_rest.zxy * 23.0));
  lie = normalize(lie + 0.22 * wave);
  float tufts = hair(at_rest, lie, 0.0042);
  float strands = 0.5;
  float fine = shown(0.0013, pixel);
  if (fine > 0.0) strands = mix(0.5, hair(at_rest, lie, 0.0013), fine);
  float shade = 0.55 * (tufts - 0.5) * shown(0.0042, pixel) + 0.75 * (strands - 0.5);
  s.albedo *= 1.0 + 0.55 * much * shade;
  float height = 0.0009 * tufts * shown(0.0042, pixel) + 0.00035 * strands;
  s.normal = bumped(s.normal, at_world, much * height);
}

void main() {
  Surface s;
  s.normal = normalize(gl_FrontFacing ? at_normal : -at_normal);
  s.to_eye = normalize(frame.eye.xyz - at_world);
  s.albedo = base_color * at_color;
#ifdef TEXTURE
  s.albedo *= texture(color_texture, at_texcoord).rgb;
#endif
  s.roughness = clamp(material.x, 0.05, 1.0);
  float metalness = material.y;
  float sheen = material.z;
  float translucency = material.w;
  float pixel = max(length(dFdx(at_rest)), length(dFdy(at_rest)));
#ifdef SKIN
  add_skin(s, pixel, min(2.0 * translucency, 1.0));
#endif
#ifdef COAT
  add_coat(s, normalize(transpose(mat3(model)) * s.normal), pixel, sheen);
#endif
  s.mirror = mix(vec3(translucency > 0.0 ? 0.028 : 0.04), s.albedo, metalness);
  s.albedo *= 1.0 - metalness;
  vec2 light = received_light(at_depth);
  color = vec4(grained(encoded(filmed(lit(s, light.x, light.y, sheen, translucency)))), 1.0);
}
