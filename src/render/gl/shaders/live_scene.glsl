#version 430 core
// What all shaders of the live picture share. Lengths in metres, relative to the picture's origin.
layout(std140, binding = 0) uniform Scene {
  vec4 eye;            // w: the nearest depth that is drawn
  vec4 right, up, back;  // the camera's axes; w of right and up: from metres at depth 1 to half a picture
  vec4 to_sun;         // unit vector; w: light, 1 by day
  vec4 sky_up;         // against gravity; w: height of the ground, if has_ground
  vec4 clip;           // what lies in front of this plane is left out: dot(xyz, x) > w
  vec4 picture;        // pixels; z: 1 where there is a ground; w: 1 dark, 0 light background
  vec4 action;         // middle; w: size
  vec4 balls;          // x: radius of a typical particle; y: strength of the relief, 0: none
};

vec3 to_view(vec3 x) {
  vec3 d = x - eye.xyz;
  return vec3(dot(right.xyz, d), dot(up.xyz, d), dot(back.xyz, d));
}
vec3 from_view(vec3 v) { return v.x * right.xyz + v.y * up.xyz + v.z * back.xyz; }

// Depth is stored as nearest / depth: 1 near, 0 far away.
float stored_depth(float depth) { return eye.w / depth; }
vec4 clip_position(vec3 v, float depth) {
  return vec4(v.x * right.w, v.y * up.w, (2.0 * stored_depth(depth) - 1.0) * -v.z, -v.z);
}

vec3 lit(vec3 color, vec3 normal, float shine) {
  float sun = max(0.0, dot(normal, to_sun.xyz));
  vec3 sky = mix(vec3(0.17, 0.16, 0.16), vec3(0.44, 0.49, 0.56), 0.5 + 0.5 * dot(normal, sky_up.xyz));
  return color * (sky + 0.80 * sun) * to_sun.w + shine;
}
