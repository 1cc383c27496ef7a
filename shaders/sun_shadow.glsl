// Shadow maps: what the sun sees of what stands still, and of what moves.
uniform sampler2DShadow still_map;
uniform sampler2DShadow moving_map;
uniform mat4 sun_from_world;
uniform float has_movers;  // 0 or 1

float Seen(sampler2DShadow map, vec3 p) {
  vec3 at = 0.5 * (sun_from_world * vec4(p, 1.0)).xyz + 0.5;
  bool outside = any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)));
  return outside ? 1.0 : texture(map, at);
}
float SeenPastMovers(vec3 p) { return has_movers > 0.5 ? Seen(moving_map, p) : 1.0; }
