#version 330 core
// Arrows: triangles of one color, under the book's light.

uniform mat4 clip_from_world;
uniform mat3 R_CW;

layout(location = 0) in vec3 point_W;
layout(location = 1) in vec3 normal_W;
layout(location = 2) in vec4 vertex_color;  // encoded, as in book.frag

out vec3 lit;

const vec3 key_direction_C = normalize(vec3(-0.40, 0.60, 0.70));

void main() {
  vec3 normal_C = R_CW * normal_W;
  float key = max(dot(normal_C, key_direction_C), 0.0);
  lit = vertex_color.rgb * pow(0.40 + 0.72 * key, 1.0 / 2.2);
  gl_Position = clip_from_world * vec4(point_W, 1.0);
}
