#version 330 core
// A vertex of the unit cube's book through the trilinear map of the eight corners, lit there: the faces are flat or finely
// divided, so light by vertex looks as light by pixel does and costs a tenth.
// Corner i lies on the positive side of axis d when bit d of i is set.

uniform vec3 corners_C[8];       // camera frame: x right, y up, z towards the eye
uniform mat4 clip_from_camera;

layout(location = 0) in vec3 unit;
layout(location = 1) in vec3 unit_normal;
layout(location = 2) in vec2 texture_place;
layout(location = 3) in float shade;

out vec2 place;
out vec3 light;   // encoded: times the encoded texture
out vec3 gloss;   // added to that

const vec3 key_direction_C = normalize(vec3(-0.40, 0.60, 0.70));
const vec3 fill_direction_C = normalize(vec3(0.80, -0.35, 0.50));
const vec3 key_color = vec3(0.74, 0.71, 0.66);
const vec3 fill_color = vec3(0.20, 0.23, 0.28);
const vec3 sky_color = vec3(0.36, 0.38, 0.41);
const vec3 ground_color = vec3(0.17, 0.16, 0.15);

void main() {
  vec3 e00 = mix(corners_C[0], corners_C[1], unit.x);
  vec3 e10 = mix(corners_C[2], corners_C[3], unit.x);
  vec3 e01 = mix(corners_C[4], corners_C[5], unit.x);
  vec3 e11 = mix(corners_C[6], corners_C[7], unit.x);
  vec3 f0 = mix(e00, e10, unit.y);
  vec3 f1 = mix(e01, e11, unit.y);
  vec3 point_C = mix(f0, f1, unit.z);

  // The map's derivative; normals go through its cofactors, which exist for a squashed book too.
  vec3 du = mix(mix(corners_C[1] - corners_C[0], corners_C[3] - corners_C[2], unit.y),
                mix(corners_C[5] - corners_C[4], corners_C[7] - corners_C[6], unit.y), unit.z);
  vec3 dv = mix(e10 - e00, e11 - e01, unit.z);
  vec3 dw = f1 - f0;
  vec3 dvw = cross(dv, dw);
  vec3 normal_C = mat3(dvw, cross(dw, du), cross(du, dv)) * unit_normal;
  if (dot(du, dvw) < 0.0) normal_C = -normal_C;  // turned inside out
  float length_squared = dot(normal_C, normal_C);
  normal_C = length_squared > 0.0 ? normal_C * inversesqrt(length_squared) : vec3(0.0, 0.0, 1.0);

  float key = max(dot(normal_C, key_direction_C), 0.0);
  float fill = max(dot(normal_C, fill_direction_C), 0.0);
  vec3 around = mix(ground_color, sky_color, 0.5 + 0.5 * normal_C.y);
  light = pow(shade * (key * key_color + fill * fill_color + around), vec3(1.0 / 2.2));

  vec3 half_way_C = normalize(key_direction_C + normalize(-point_C));
  gloss = 0.06 * shade * pow(max(dot(normal_C, half_way_C), 0.0), 24.0) * vec3(1.0, 0.98, 0.94);

  place = texture_place;
  gl_Position = clip_from_camera * vec4(point_C, 1.0);
}
