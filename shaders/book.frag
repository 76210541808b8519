#version 330 core
// Texture and frame buffer are sRGB, so all of this is linear light.

uniform sampler2D picture;

in vec2 place;
in vec3 light;
in vec3 gloss;
out vec4 color;

void main() { color = vec4(texture(picture, place).rgb * light + gloss, 1.0); }
