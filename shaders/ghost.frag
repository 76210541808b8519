#version 330 core
// The ghost: the book's picture as a pale tint that what lies behind shines through.

uniform sampler2D picture;
uniform vec3 tint;      // linear
uniform float opacity;

in vec2 place;
in vec3 light;
in vec3 gloss;
out vec4 color;

void main() {
  float grey = dot(texture(picture, place).rgb, vec3(0.2126, 0.7152, 0.0722));
  color = vec4(tint * (0.25 + 0.75 * sqrt(grey)) * (0.35 + light) + gloss, opacity);
}
