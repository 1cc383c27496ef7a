#version 330 core
layout(location = 0) in vec3 position_W;
uniform mat4 clip_from_world;
uniform mat4 picture_from_world;
uniform float ui_scale;
out vec2 north_east;
out vec4 on_picture;
void main() {
  gl_Position = clip_from_world * vec4(position_W, 1.0);
  gl_PointSize = 2.5 * ui_scale;
  north_east = position_W.xy;
  on_picture = picture_from_world * vec4(position_W, 1.0);
}
