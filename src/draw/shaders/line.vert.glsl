// A line as a strip of a width in pixels, with a soft edge.
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec3 color;
layout(location = 3) in float width;

flat out vec3 at_color;
flat out float at_half_width;
noperspective out float at_across;

const float kNear = 1e-3;

void main() {
  vec4 a = frame.projection * (frame.view * vec4(from, 1.0));
  vec4 b = frame.projection * (frame.view * vec4(to, 1.0));
  if (a.w < kNear && b.w > kNear) a = mix(a, b, (kNear - a.w) / (b.w - a.w));
  if (b.w < kNear && a.w > kNear) b = mix(b, a, (kNear - b.w) / (a.w - b.w));
  vec2 along = (b.xy / b.w - a.xy / a.w) * frame.size.xy;
  float length_px = length(along);
  along = length_px > 1e-6 ? along / length_px : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  bool at_end = gl_VertexID >= 2;
  float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
  float reach = 0.5 * width + 1.0;
  vec4 place = at_end ? b : a;
  place.xy += 2.0 * (side * reach * across) * frame.size.zw * place.w;
  // A line that lies on a surface stays on top of it.
  place.z -= 5e-5 * place.w;
  gl_Position = place;
  at_color = color;
  at_half_width = 0.5 * width;
  at_across = side * reach;
}
