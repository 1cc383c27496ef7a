#version 330 core
layout(location = 0) in vec3 position_W;
layout(location = 1) in vec3 normal_W;
layout(location = 2) in vec2 surface_m;  // place on the surface, for its grain
layout(location = 3) in float grey;
uniform mat4 clip_from_world;
uniform vec3 camera_W;
uniform vec3 moved_W;  // since time 0
out vec3 place_W;
out vec3 normal;
out vec2 grain_at;
out float albedo;
void main() {
  place_W = position_W + moved_W;
  gl_Position = clip_from_world * vec4(place_W - camera_W, 1.0);
  normal = normal_W;
  grain_at = surface_m;
  albedo = grey;
}
