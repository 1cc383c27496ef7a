#version 330 core
in vec2 ndc;
out vec4 colour;
// #0E1319 at the top, #181F27 at the bottom; y runs down.
void main() {
  vec3 top = vec3(14.0, 19.0, 25.0) / 255.0, bottom = vec3(24.0, 31.0, 39.0) / 255.0;
  colour = vec4(mix(top, bottom, ndc.y * 0.5 + 0.5), 1.0);
}
