#version 330 core
in vec2 north_east;
in vec4 on_picture;
uniform sampler2D cells;
uniform sampler2D picture;
uniform float has_picture;
uniform vec2 map_corner;  // north maximum, east minimum
uniform vec2 map_size_m;
uniform float ui_scale;
uniform int kind;  // 0 unknown ground, 1 surface, 2 tall points
out vec4 colour;

const vec3 kUnknown = vec3(27.0, 34.0, 43.0) / 255.0;
const vec3 kUnknownLine = vec3(58.0, 69.0, 82.0) / 255.0;
const vec3 kUnsafe = vec3(240.0, 150.0, 60.0) / 255.0;

// Lines at 45 degrees, fixed to the screen.
float Hatch(float period_px, float width_px) {
  float across = mod((gl_FragCoord.x + gl_FragCoord.y) / ui_scale, period_px * 1.41421356);
  return clamp((width_px * 1.41421356 - across) * 0.7 + 0.5, 0.0, 1.0);
}

void main() {
  if (kind == 0) {
    colour = vec4(mix(kUnknown, kUnknownLine, Hatch(6.0, 1.0)), 1.0);
    return;
  }
  float brightness = 0.5;
  if (has_picture > 0.5 && on_picture.w > 0.0) {
    vec2 uv = on_picture.xy / on_picture.w;
    if (all(greaterThan(uv, vec2(0.0))) && all(lessThan(uv, vec2(1.0)))) {
      brightness = texture(picture, uv).r;
    }
  }
  vec2 offset = vec2(north_east.y - map_corner.y, map_corner.x - north_east.x);
  vec4 cell = texture(cells, offset / map_size_m.yx);
  vec3 grey = vec3(0.10 + 1.0 * brightness);
  float exposure = min(0.55 + 0.95 * brightness, 1.12);
  vec3 safe = min(cell.rgb * exposure, vec3(1.0));
  vec3 unsafe = mix(grey * 0.75, kUnsafe, 0.30 + 0.55 * Hatch(5.0, 1.3));
  vec3 plain = grey * 0.8;
  vec3 shade = cell.a > 0.75 ? safe : cell.a > 0.25 ? unsafe : plain;
  colour = vec4(kind == 2 ? mix(grey, kUnsafe, 0.55) : shade, 1.0);
}
