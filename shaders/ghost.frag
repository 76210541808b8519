#version 330 core
// The ghost: the book's picture as a pale tint that what lies behind shines through, and its edges, drawn on the faces that are seen.
// Encoded colors, as in book.frag. Every face of the cuboid fills the unit square of texture coordinates.

uniform sampler2D picture;
uniform vec3 tint;
uniform float opacity;

in vec2 place;
in vec3 light;
in vec3 gloss;
out vec4 color;

const float edge_width = 1.6;  // pixels, on either side of an edge

void main() {
  float gray = dot(texture(picture, place).rgb, vec3(0.3, 0.6, 0.1));
  vec2 to_edge = min(place, 1.0 - place) / max(fwidth(place), 1e-6);  // pixels
  float edge = clamp(edge_width + 0.5 - min(to_edge.x, to_edge.y), 0.0, 1.0);
  color = vec4(mix(tint * (0.30 + 0.70 * gray) * light + gloss, tint, edge), mix(opacity, 0.85, edge));
}
