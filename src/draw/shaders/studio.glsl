// The studio: three lights, soft walls all about, and the film that takes the picture.
const float kPi = 3.14159265;
const vec3 kKeyColor = 3.3 * vec3(1.0, 0.955, 0.89);
const vec3 kFillColor = 0.45 * vec3(0.88, 0.94, 1.0);
const vec3 kRimColor = 1.10 * vec3(0.95, 0.97, 1.0);

/// Light of the walls, ceiling and floor that arrives on a surface with this normal.
vec3 irradiance(vec3 normal) {
  float up = 0.5 + 0.5 * normal.y;
  vec3 ambient = mix(vec3(0.30, 0.28, 0.265), vec3(0.62, 0.64, 0.67), up * up * (3.0 - 2.0 * up));
  return ambient * (0.92 + 0.16 * dot(normal, frame.fill_light.xyz));
}

/// A softbox about a direction, seen in a mirror of some roughness; `size` is half its angle.
float softbox(vec3 direction, vec3 center, float size, float roughness) {
  float away = sqrt(max(2.0 - 2.0 * dot(direction, center), 0.0));
  float blur = 0.05 + 0.9 * roughness;
  return smoothstep(size + blur, size - blur, away) / (1.0 + 2.0 * roughness * roughness);
}

/// What a mirror of some roughness sees of the studio.
vec3 reflected_studio(vec3 direction, float roughness) {
  float height = direction.y;
  float horizon = 0.1 + 0.6 * roughness;
  vec3 walls = mix(vec3(0.34, 0.33, 0.32), vec3(0.62, 0.64, 0.66),
                   smoothstep(-horizon, horizon, height));
  walls = mix(walls, vec3(0.85), smoothstep(0.2, 1.0 + horizon, height));
  walls += 1.1 * softbox(direction, frame.fill_light.xyz, 0.35,
                         roughness);
  walls += 1.4 * softbox(direction, frame.rim_light.xyz, 0.25, roughness);
  return walls;
}

/// Light as film shows it, 0 to 1 and still linear.
// Based on: Narkowicz. ACES Filmic Tone Mapping Curve. 2015 (the fit).
vec3 filmed(vec3 light) {
  vec3 x = 0.56 * mix(vec3(dot(light, vec3(0.2126, 0.7152, 0.0722))), light, 0.90);
  return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

/// The backdrop in a direction of the world, as it is shown: lighter where the eye looks.
vec3 backdrop(vec3 direction) {
  float away = 1.0 - dot(direction, frame.forward.xyz);
  float shade = 1.0 - 0.30 * smoothstep(0.0, 0.28, away);
  vec3 wall = mix(vec3(0.80, 0.81, 0.82), vec3(0.70, 0.715, 0.735),
                  smoothstep(-0.3, 0.6, direction.y));
  return wall * shade;
}
