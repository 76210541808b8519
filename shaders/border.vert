#version 330 core
// The borders of a book's faces: strips that lie in the faces and have one width on the screen.

uniform vec3 corners_C[8];
uniform mat4 clip_from_camera;
uniform vec2 half_frame;  // pixels
uniform vec4 color;

layout(location = 0) in vec3 unit;
layout(location = 1) in vec3 along;    // two directions in the face
layout(location = 2) in vec3 across;
layout(location = 3) in vec2 inwards;  // whether, and which way, along each of them this vertex lies within the face

out vec4 flat_color;

const float width = 2.0;  // pixels

vec4 clip_at(vec3 p) {
  vec3 f0 = mix(mix(corners_C[0], corners_C[1], p.x), mix(corners_C[2], corners_C[3], p.x), p.y);
  vec3 f1 = mix(mix(corners_C[4], corners_C[5], p.x), mix(corners_C[6], corners_C[7], p.x), p.y);
  return clip_from_camera * vec4(mix(f0, f1, p.z), 1.0);
}

// Pixels a unit of the direction.
vec2 on_screen(vec4 clip, vec3 direction) {
  vec4 change = 100.0 * (clip_at(unit + 0.01 * direction) - clip);
  return half_frame * (change.xy * clip.w - clip.xy * change.w) / (clip.w * clip.w);
}

void main() {
  flat_color = color;
  vec4 clip = clip_at(unit);
  vec2 a = on_screen(clip, along);
  vec2 b = on_screen(clip, across);
  // How far to go in one direction for the width from the border that runs in the other; the middle at most.
  vec2 far = width * vec2(length(b), length(a)) / max(abs(a.x * b.y - a.y * b.x), 1e-6);
  vec2 inner = min(far, 0.5) * inwards;
  gl_Position = clip_at(unit + inner.x * along + inner.y * across);
}
