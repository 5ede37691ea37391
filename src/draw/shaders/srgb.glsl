/// Linear light, 0 to 1, as sRGB; a fit by roots that is at most a tenth of 1/255 off.
vec3 encoded(vec3 linear) {
  vec3 c = clamp(linear, 0.0, 1.0);
  vec3 root = sqrt(c);
  vec3 curve = 0.83376 * root + 0.29811 * sqrt(root) - 0.05532 * c - 0.07655;
  return mix(12.92 * c, curve, step(0.0031308, c));
}

/// As stored in 8 bits, with a grain of half a step that is the same in every picture: so soft
/// gradients do not fall into bands.
// Based on: Jimenez. Next Generation Post Processing in Call of Duty: Advanced Warfare. 2014
// (interleaved gradient noise).
vec3 grained(vec3 shown) {
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  return shown + (noise - 0.5) / 255.0;
}
