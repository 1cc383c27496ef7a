#version 330 core
layout(location = 0) in vec3 position_W;
layout(location = 1) in vec3 normal_W;
layout(location = 2) in vec2 surface_m;  // place on the surface, for its grain
layout(location = 3) in float grey;
uniform mat4 clip_from_world;
uniform vec3 camera_W;
uniform vec3 sun_W;
uniform float ambient;
uniform float sun;
out vec2 place_m;
out float albedo;
out float light;
void main() {
  gl_Position = clip_from_world * vec4(position_W - camera_W, 1.0);
  place_m = surface_m;
  albedo = grey;
  light = ambient + sun * max(dot(normal_W, sun_W), 0.0);
}
