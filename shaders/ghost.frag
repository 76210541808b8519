#version 330 core
// The ghost's faces: the book's picture as a pale tint that what lies behind shines through. Encoded colors, as in book.frag.

uniform sampler2D picture;
uniform vec3 tint;

in vec2 place;
in vec3 light;
in vec3 gloss;
out vec4 color;

void main() {
  float gray = dot(texture(picture, place).rgb, vec3(0.3, 0.6, 0.1));
  color = vec4(tint * (0.30 + 0.70 * gray) * light + gloss, 0.40);
}
