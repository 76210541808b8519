#version 330 core
// Lines arrive as triangles in clip coordinates: their width is in pixels.

layout(location = 0) in vec4 clip;
layout(location = 1) in vec4 vertex_color;  // encoded, straight alpha

out vec4 flat_color;

void main() {
  flat_color = vertex_color;
  gl_Position = clip;
}
