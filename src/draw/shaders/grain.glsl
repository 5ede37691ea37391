/// Smooth noise, 0 to 1, without direction and with one bump a unit.
float hashed(ivec3 cell) {
  uint h = uint(cell.x) * 0x8da6b343u + uint(cell.y) * 0xd8163841u + uint(cell.z) * 0xcb1ab31fu;
  h ^= h >> 13;
  h *= 0x5bd1e995u;
  h ^= h >> 15;
  return float(h & 0xffffu) / 65535.0;
}
float noise(vec3 at) {
  ivec3 cell = ivec3(floor(at));
  vec3 t = at - floor(at);
  t = t * t * (3.0 - 2.0 * t);
  vec4 low = vec4(hashed(cell), hashed(cell + ivec3(1, 0, 0)), hashed(cell + ivec3(0, 1, 0)),
                  hashed(cell + ivec3(1, 1, 0)));
  vec4 high = vec4(hashed(cell + ivec3(0, 0, 1)), hashed(cell + ivec3(1, 0, 1)),
                   hashed(cell + ivec3(0, 1, 1)), hashed(cell + ivec3(1, 1, 1)));
  vec4 along_z = mix(low, high, t.z);
  vec2 along_y = mix(along_z.xy, along_z.zw, t.y);
  return mix(along_y.x, along_y.y, t.x);
}

/// A normal as bumps of a height (metres) make it.
// Based on: Mikkelsen. Bump Mapping Unparametrized Surfaces on the GPU. 2010.
vec3 bumped(vec3 normal, vec3 world, float height) {
  vec3 across = dFdx(world);
  vec3 up = dFdy(world);
  vec3 a = cross(up, normal);
  vec3 b = cross(normal, across);
  float area = dot(across, a);
  vec3 slope = sign(area) * (dFdx(height) * a + dFdy(height) * b);
  vec3 turned = abs(area) * normal - slope;
  float turned_length = length(turned);
  return turned_length > 0.0 ? turned / turned_length : normal;
}

/// How much of a grain of this size (metres) a pixel can still show.
float shown(float size, float pixel) { return 1.0 - smoothstep(0.35, 0.9, pixel / size); }

/// Fur: noise drawn out along the lie of the hair, 0 to 1 about 0.5.
// Based on: Cabral, Leedom. Imaging Vector Fields Using Line Integral Convolution. 1993.
float hair(vec3 at, vec3 lie, float width) {
  float sum = 0.0;
  for (int i = -1; i <= 1; ++i) sum += noise((at + 1.9 * float(i) * width * lie) / width);
  return clamp(0.5 + 1.3 * (sum / 3.0 - 0.5), 0.0, 1.0);
}
