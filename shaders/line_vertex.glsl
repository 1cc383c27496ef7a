#version 330 core
layout(location = 0) in vec4 clip;
layout(location = 1) in vec4 colour_in;
out vec4 shade;
void main() {
  gl_Position = clip;
  shade = colour_in;
}
