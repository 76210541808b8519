#version 330 core
// The ghost: the book's picture as a pale tint that what lies behind shines through, and its edges, drawn on the faces that are seen.
// Encoded colors, as in book.frag. Each cover and the spine fill the unit square of texture coordinates; the narrow sides of
// the boards lie at its very border.

uniform sampler2D picture;
uniform vec3 tint;
uniform vec2 opacity;  // of the faces, of the edges

in vec2 place;
in vec3 light;
in vec3 gloss;
out vec4 color;

const float edge_width = 1.6;  // pixels, on either side of an edge
const float border = 0.0045;   // of the unit square

void main() {
  float gray = dot(texture(picture, place).rgb, vec3(0.3, 0.6, 0.1));
  vec2 inside = min(place, 1.0 - place);
  vec2 to_edge = inside / max(fwidth(place), 1e-6);  // pixels
  float edge = clamp(edge_width + 0.5 - min(to_edge.x, to_edge.y), 0.0, 1.0);
  if (min(inside.x, inside.y) < border) edge = 1.0;
  color = vec4(mix(tint * (0.30 + 0.70 * gray) * light + gloss, tint, edge), mix(opacity.x, opacity.y, edge));
}
