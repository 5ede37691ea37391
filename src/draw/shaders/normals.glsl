// Based on: Cigolle, Donow, Evangelakos, Mara, McGuire, Meyer. A Survey of Efficient
// Representations for Independent Unit Vectors. 2014.
vec2 outward_sign(vec2 v) { return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0); }

/// A unit vector as a point of a square.
vec2 packed_normal(vec3 n) {
  vec2 flat_part = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  return n.z >= 0.0 ? flat_part : (1.0 - abs(flat_part.yx)) * outward_sign(flat_part);
}
vec3 unpacked_normal(vec2 p) {
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * outward_sign(n.xy);
  return normalize(n);
}
