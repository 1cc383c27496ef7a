#version 330 core
layout(location = 0) in vec3 place;  // north, east, height of the relief; metres
uniform mat4 clip_from_world;        // of positions relative to the camera
uniform vec3 camera_W;
uniform vec4 mirror;  // north = x * north + y, east = z * east + w
uniform vec2 rise;
uniform float lower_m;
out vec3 place_W;
void main() {
  vec2 p = vec2(mirror.x * place.x + mirror.y, mirror.z * place.y + mirror.w);
  place_W = vec3(p, lower_m - place.z - dot(rise, p));
  gl_Position = clip_from_world * vec4(place_W - camera_W, 1.0);
}
