#version 330 core
// How far the sun's light gets, past surfaces.
uniform float range;       // depth of the map, m

in vec3 view_position;

void main() { gl_FragDepth = -view_position.z / range; }
