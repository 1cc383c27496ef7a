#version 330 core
// Ground to be lit by lit_resolve_fragment.glsl: black, which nothing else is.
out vec4 colour;
void main() { colour = vec4(0.0, 0.0, 0.0, 1.0); }
