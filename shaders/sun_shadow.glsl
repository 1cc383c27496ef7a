// Shadow maps: what the sun sees of what stands still, and of what moves. A constant piece before
// this one says whether anything does (has_movers): software drivers go both ways round an `if`.
uniform sampler2DShadow still_map;
uniform sampler2DShadow moving_map;
uniform mat4 sun_from_world;

float Seen(sampler2DShadow map, vec3 p) {
  vec3 at = 0.5 * (sun_from_world * vec4(p, 1.0)).xyz + 0.5;
  bool outside = any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)));
  return outside ? 1.0 : texture(map, at);
}
float SeenPastMovers(vec3 p) { return has_movers ? Seen(moving_map, p) : 1.0; }
