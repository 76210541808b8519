#version 330 core
// Light is reckoned linearly, colors are kept encoded: sRGB is close to the power law x^(1/2.2), which makes a product of linear values
// the product of the encoded ones. So encoded light by vertex times encoded texture is linear-light shading, without the conversions
// that would cost as much as all the rest.

uniform sampler2D picture;
uniform float brightness;

in vec2 place;
in vec3 light;  // encoded
in vec3 gloss;  // added to the encoded color
out vec4 color;

void main() { color = vec4((texture(picture, place).rgb * light + gloss) * brightness, 1.0); }
