#version 330 core
// From pixels to points of view space. Lengths in metres; view space looks along -z.
uniform vec2 picture;        // pixels
uniform float scale;         // pixels a metre at depth 1

vec3 view_point(vec2 pixel, float depth) { return depth * vec3((pixel - 0.5 * picture) / scale, -1.0); }

// Noise that is evenly spread over any few pixels (J. Jimenez, "Next generation post processing in Call of Duty",
// 2014).
float noise(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }
