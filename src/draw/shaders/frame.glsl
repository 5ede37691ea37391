// What every shader knows of the picture; the layout is that of FrameUniforms.
layout(std140, binding = 0) uniform Frame {
  mat4 view;
  mat4 projection;
  mat4 near_shadow;
  mat4 wide_shadow;
  vec4 eye;
  vec4 forward;
  vec4 size;
  vec4 unproject;
  vec4 key_light;
  vec4 fill_light;
  vec4 rim_light;
  vec4 near_extent;
  vec4 wide_extent;
  vec4 near_casters;
  vec4 wide_casters;
  vec4 solids_low;
  vec4 solids_high;
  vec4 focus;
  vec4 floor_place;
} frame;

/// Where in the eye's frame a pixel is that shows something at a depth (metres, above 0).
vec3 eye_position(vec2 pixel, float depth) {
  vec2 clip = 2.0 * pixel * frame.size.zw - 1.0;
  return vec3(depth * (frame.unproject.xy * clip + frame.unproject.zw), -depth);
}
vec3 to_world(vec3 position_eye) {
  return transpose(mat3(frame.view)) * position_eye + frame.eye.xyz;
}
