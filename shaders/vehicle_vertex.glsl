#version 330 core
layout(location = 0) in vec3 position_B;
layout(location = 1) in vec3 normal_B;
layout(location = 2) in float grey;
uniform mat4 clip_from_body;
uniform mat3 world_from_body;
out vec3 normal_W;
out float albedo;
void main() {
  gl_Position = clip_from_body * vec4(position_B, 1.0);
  normal_W = world_from_body * normal_B;
  albedo = grey;
}
